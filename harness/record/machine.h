// What ran the bench, for result.json.
#pragma once

#include <nlohmann/json.hpp>

namespace towbench::harness {

[[nodiscard]] nlohmann::json describe_machine();

}  // namespace towbench::harness
