// Several exit codes as one.
#pragma once

#include "harness/checks/check.h"

namespace towbench::harness {

// What matters more: a broken run, then one that proves nothing, then a failed one.
[[nodiscard]] constexpr int graver(int a, int b) noexcept {
  constexpr auto gravity = [](int code) {
    switch (code) {
      case kExitPass:
        return 0;
      case kExitFail:
        return 1;
      case kExitInvalid:
        return 2;
      default:
        return 3;
    }
  };
  return gravity(b) > gravity(a) ? b : a;
}

}  // namespace towbench::harness
