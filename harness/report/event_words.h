// An event of events.jsonl in words.
#pragma once

#include <string>

#include <nlohmann/json.hpp>

namespace towbench::harness::report {

// HTML. Members that the kind does not explain are appended by name, unless they are zero or empty.
[[nodiscard]] std::string event_words(const nlohmann::json& event);

}  // namespace towbench::harness::report
