// The speed by each of BBMC's estimators (thesis 3.4.2), whichever of them the controller follows:
// its own class, fed with its own counts and with registers that were read for those who observe.
#pragma once

#include <array>
#include <cstdint>
#include <utility>
#include <vector>

#include "bbmc/system/velocity_estimator.h"
#include "core/axis.h"
#include "harness/panel/live_row.h"
#include "harness/panel/shown_configuration.h"

namespace towbench::harness {

class LiveEstimators {
 public:
  static constexpr std::size_t kMethods = 3;  // in the order of bbmc::VelocityMethod
  using Speeds = core::PerAxis<std::array<double, kMethods>>;

  explicit LiveEstimators(const ShownMachine& machine);

  // Rows in order. Speeds in m/s, motor side.
  [[nodiscard]] Speeds update(const LiveRow& row) noexcept;

 private:
  struct OfAxis {
    std::array<bbmc::VelocityEstimator, kMethods> by;
    double m_per_count;
    double capture_clock_Hz;
    std::int64_t last_count = 0;
    std::int64_t declared = 0;  // what homing and calibrating added to the count
    bool started = false;
  };
  static OfAxis of_axis(const bbmc::AxisConfiguration& axis, double control_rate_Hz) noexcept;

  std::vector<std::pair<core::Axis, OfAxis>> axes_;
};

}  // namespace towbench::harness
