// How deep a TOML text nests, before anything recursive reads it.
#pragma once

#include <cstddef>
#include <string_view>

namespace towbench::harness {

inline constexpr std::size_t kDeepestToml = 32;

// The line on which a key of more than kDeepestToml dotted parts, or more brackets one within
// another, begins; 0 when there is none. Strings and comments do not count.
[[nodiscard]] std::size_t line_nested_too_deep(std::string_view text) noexcept;

}  // namespace towbench::harness
