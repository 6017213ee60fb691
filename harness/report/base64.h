// RFC 4648 base64, for bytes inside HTML.
#pragma once

#include <cstdint>
#include <span>
#include <string>

namespace towbench::harness::report {

[[nodiscard]] std::string base64(std::span<const std::uint8_t> bytes);

}  // namespace towbench::harness::report
