// Stands where it is.
#pragma once

#include "bbmc/system/trajectory/reference.h"

namespace towbench::bbmc {

class Hold {
 public:
  Hold() noexcept = default;
  explicit Hold(double position_m, double duration_s = 0.0) noexcept
      : position_m_(position_m), duration_s_(duration_s) {}

  [[nodiscard]] Reference at(double /*time_s*/) const noexcept {
    return {.position_m = position_m_};
  }
  [[nodiscard]] double duration_s() const noexcept { return duration_s_; }

 private:
  double position_m_ = 0;
  double duration_s_ = 0;
};

}  // namespace towbench::bbmc
