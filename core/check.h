// A broken invariant is a bug, not a condition: stop at once, where it shows.
#pragma once

#include <cstdlib>

namespace towbench::core {

constexpr void check(bool invariant) noexcept {
  if (!invariant) [[unlikely]] {
    std::abort();
  }
}

}  // namespace towbench::core
