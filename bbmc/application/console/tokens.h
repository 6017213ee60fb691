// A command line cut into words.
#pragma once

#include <cstddef>
#include <string_view>

#include "core/bounded_vector.h"
#include "core/result.h"

namespace towbench::bbmc {

inline constexpr std::size_t kMaxLineLength = 256;
inline constexpr std::size_t kMaxTokens = 32;

using Tokens = core::BoundedVector<std::string_view, kMaxTokens>;

// Words between spaces and tabs; "--name=value" is two words. The views point into `line`.
// kRequestBadArgument for more than kMaxTokens words or a byte that is not printable ASCII.
[[nodiscard]] core::Result<Tokens> split_line(std::string_view line) noexcept;

}  // namespace towbench::bbmc
