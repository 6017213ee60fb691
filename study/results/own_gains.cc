#include "study/results/own_gains.h"

#include "study/results/thesis_tracking.h"

namespace towbench::study {
namespace {

// 131,072 rows of 1 kHz hold what BBMC 0.5 recorded, 0.5 s of rest and both ramps included.
constexpr double kLongestSteady_s = 131.072 - 0.5 - 2 * 0.8;

}  // namespace

OwnGains track_gains(const harness::RigFixture& rig, const harness::ControllerFixture& controller) {
  const auto& y = controller.configuration.axes[core::Axis::kY];
  OwnGains own;
  own.controller = controller.name;
  own.proportional_Nm_per_count = y.gains.proportional_Nm_per_rad * y.rad_per_count();
  own.integral_Nm_per_count_s = y.gains.integral_Nm_per_rad_s * y.rad_per_count();
  own.derivative_Nm_s_per_count = y.gains.derivative_Nm_s_per_rad * y.rad_per_count();
  own.m_per_count = y.m_per_count();
  const double track_m = static_cast<double>(y.ends.soft_max_count) * y.m_per_count() -
                         rig.parameters.axes[core::Axis::kY].start_m -
                         0.05;  // clear of the soft limit
  const auto slow = speeds_of(kTable7_6);
  own.early = track_speeds(rig, controller, slow, {}, {});
  own.whole = track_speeds(rig, controller, slow, {.settle_s = 0},
                           {.longest_s = kLongestSteady_s, .track_m = track_m});
  own.fast =
      track_speeds(rig, controller, speeds_of(kTable8_3), {.smooth_s = 0.243, .settle_s = 0.3}, {});
  own.circle = track_circle(rig, controller, 1);
  return own;
}

}  // namespace towbench::study
