// Everything a user may set of BBMC before it starts; some of it also while it runs
// (system_manager.h says what). Plain, SI, with defaults, described once by visit().
#pragma once

#include <cstdint>

#include "bbmc/device/axes.h"
#include "bbmc/system/axis_configuration.h"
#include "core/parameter.h"
#include "core/time.h"

namespace towbench::bbmc {

struct AxesConfiguration : PerAxis<AxisConfiguration> {
  template <typename Visitor>
  void visit(Visitor& v) {
    v.group("y", (*this)[core::Axis::kY], "along the tank");
    v.group("x", (*this)[core::Axis::kX], "across the tank, on Y's carriage");
  }
};

struct SafetyConfiguration {
  bool coasting_stop = false;       // cut the current instead of braking: for comparison only
  double latency_s = 2.5e-3;        // from an end-stop's edge to braking torque, worst case
  double speed_margin_ratio = 1.1;  // run-time speed guard over what planning allows
  double start_tolerance_m = 1e-3;  // a reference must start where the axis stands
  double tracking_error_limit_m = 0.05;
  double link_timeout_s = 20e-3;  // no sample of an encoder for so long: link lost
  bool amplifier_ready_fitted = true;
  double amplifier_ready_timeout_s = 0.1;

  template <typename Visitor>
  void visit(Visitor& v) {
    v.value("coasting_stop", coasting_stop, core::any_finite(),
            "a safety stop cuts the current instead of braking; for comparison only");
    v.value("latency_s", latency_s, core::between(0.0, 0.1),
            "from an end-stop's edge to braking torque, worst case");
    v.value("speed_margin_ratio", speed_margin_ratio, core::between(1.0, 2.0),
            "speed at which the run-time guard acts, over the speed that planning allows");
    v.value("start_tolerance_m", start_tolerance_m, core::above(0.0),
            "largest distance between an axis and the start of its reference");
    v.value("tracking_error_limit_m", tracking_error_limit_m, core::above(0.0),
            "further from its reference an axis is stopped");
    v.value("link_timeout_s", link_timeout_s, core::between(1e-3, 10.0),
            "without a sample of an encoder for so long the link is lost");
    v.value("amplifier_ready_fitted", amplifier_ready_fitted, core::any_finite(),
            "whether the amplifiers report that they are ready");
    v.value("amplifier_ready_timeout_s", amplifier_ready_timeout_s, core::between(1e-3, 10.0),
            "longest time from enable to ready");
  }
};

// Goto: speed control until near, then position control.
struct GotoConfiguration {
  double speed_count_per_s = 40'000;       // firmware
  double fast_speed_count_per_s = 80'000;  // firmware, -f
  double final_distance_count = 10'000;    // firmware
  double acceleration_m_per_s2 = 0.5;
  std::int64_t done_within_counts = 0;  // firmware: 500
  double settle_time_s = 0.1;
  double timeout_s = 10.0;  // after the profile's end

  template <typename Visitor>
  void visit(Visitor& v) {
    v.value("speed_count_per_s", speed_count_per_s, core::above(0.0), "of the long leg");
    v.value("fast_speed_count_per_s", fast_speed_count_per_s, core::above(0.0), "with -f");
    v.value("final_distance_count", final_distance_count, core::above(0.0),
            "position control takes over so far from the target");
    v.value("acceleration_m_per_s2", acceleration_m_per_s2, core::between(1e-3, 10.0),
            "of start and approach");
    v.value("done_within_counts", done_within_counts, core::between(0, 100'000),
            "both axes this close to their targets");
    v.value("settle_time_s", settle_time_s, core::between(0.0, 10.0), "for so long");
    v.value("timeout_s", timeout_s, core::between(0.1, 600.0),
            "motion ends so long after its reference stands, settled or not");
  }
};

// Of the 2-D path (thesis 9.3.2): the error across the path pulls both axes back, on top of what
// each axis's own law does (cross_coupling.h).
struct CrossCouplingConfiguration {
  bool enabled = false;
  double ratio = 1.0;

  template <typename Visitor>
  void visit(Visitor& v) {
    v.value("enabled", enabled, core::any_finite(), "whether the axes share the path's error");
    v.value("ratio", ratio, core::between(0.0, 10.0),
            "gain on the error across the path, over each axis's K_P");
  }
};

struct Configuration {
  double control_rate_Hz = 1000.0;  // OR-BBMC-3b: 1 .. 5000
  double hold_time_s = 0.2;         // position held after a reference has ended, before power off
  AxesConfiguration axes;
  SafetyConfiguration safety;
  GotoConfiguration go_to;
  CrossCouplingConfiguration cross_coupling;

  Configuration() noexcept { axes[core::Axis::kX] = x_axis_defaults(); }

  template <typename Visitor>
  void visit(Visitor& v) {
    v.value("control_rate_Hz", control_rate_Hz, core::between(1.0, 5000.0),
            "control ticks a second; the period is a multiple of 100 us");
    v.value("hold_time_s", hold_time_s, core::between(0.0, 3600.0),
            "how long the end of a motion is held before power goes off");
    v.group("axis", axes, "the two axes");
    v.group("safety", safety, "when and how motion is stopped");
    v.group("goto", go_to, "pick-and-place motion");
    v.group("cross_coupling", cross_coupling, "of the two axes along a path");
  }

  [[nodiscard]] core::Nanoseconds control_period_ns() const noexcept {
    return core::nanoseconds(1.0 / control_rate_Hz);
  }
};

// Gains with which the sampled loop cannot be stable at a control rate, whatever the load.
[[nodiscard]] bool gains_are_unstable(const AxisConfiguration& axis, const PidGains& gains,
                                      double control_rate_Hz) noexcept;

// What must hold between values and no single range can say: a sentence that names the key. Null
// when all is well.
[[nodiscard]] const char* inconsistency(const Configuration& configuration) noexcept;

// How often the board is served: the longest part of the control period that is not above 1 ms and
// a multiple of 100 us. The period itself is a multiple of 100 us.
[[nodiscard]] core::Nanoseconds exchange_period_ns(core::Nanoseconds control_period_ns) noexcept;

}  // namespace towbench::bbmc
