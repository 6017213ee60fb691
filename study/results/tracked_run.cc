#include "study/results/tracked_run.h"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "harness/fault_cases/case_run.h"
#include "study/procedures/machine.h"

namespace towbench::harness {
namespace {

using core::Axis;

ExperimentFixture fixture_of(const RigFixture& rig, const ControllerFixture& controller,
                             const TrapezoidRun& run) {
  ExperimentFixture fixture;
  fixture.rig = rig;
  fixture.controller = controller;
  fixture.experiment.name = "tracked trapezoid";
  auto& steps = fixture.experiment.console;
  for (const auto axis : core::kAxes) {
    steps.push_back(procedures::say(fmt::format("reset poscalib {} {:.6f}m", core::name_of(axis),
                                                rig.parameters.axes[axis].start_m)));
  }
  const double longest_s = run.distance_m / run.speed_m_per_s + 20;
  steps.push_back(procedures::move(
      fmt::format("run -trapez y --distance {:.4f}m --speed {:.4f}m/s --acceleration {:.3f}s "
                  "--smooth {:.3f}s",
                  run.distance_m, run.speed_m_per_s, run.acceleration_s, run.smooth_s),
      longest_s));
  fixture.experiment.duration_limit_s = longest_s + 10;
  return fixture;
}

}  // namespace

TrackedRun track_trapezoid(const RigFixture& rig, const ControllerFixture& controller,
                           const TrapezoidRun& run, std::uint64_t seed) {
  const auto fixture = fixture_of(rig, controller, run);
  const auto record = run_case(fixture, fixture.rig.parameters, {}, {.seed = seed});
  TrackedRun tracked;
  tracked.trouble = record->outcome.script_failure;
  if (const auto* fault = record->first_fault(); fault != nullptr) {
    tracked.trouble = std::string(core::describe(fault->code));
  }
  double steady = 0;
  double followed = 0;
  double steady_from_s = -1;
  for (const auto& row : record->log) {
    const auto& y = row.axes[Axis::kY];
    if (y.mode != bbmc::AxisMode::kPosition) {
      continue;
    }
    const double error = y.reference_m - y.position_m;
    const double carriage = y.reference_m - record->truth_at(row.time_ns).axes[Axis::kY].carriage_m;
    tracked.peak_m = std::max(tracked.peak_m, std::fabs(error));
    tracked.carriage_peak_m = std::max(tracked.carriage_peak_m, std::fabs(carriage));
    tracked.carriage_mean_m += std::fabs(carriage);
    followed += 1;
    const double now_s = core::seconds(row.time_ns);
    if (y.reference_velocity_m_per_s < (1 - 1e-6) * run.speed_m_per_s) {
      continue;
    }
    steady_from_s = steady_from_s < 0 ? now_s : steady_from_s;
    if (now_s >= steady_from_s + run.settle_s) {
      steady += 1;
      tracked.mean_m += error;
      tracked.rms_m += error * error;
      tracked.speed_mean_m_per_s += y.reference_velocity_m_per_s - y.velocity_m_per_s;
    }
  }
  if (followed > 0) {
    tracked.carriage_mean_m /= followed;
  }
  if (steady > 0) {
    tracked.mean_m /= steady;
    tracked.rms_m = std::sqrt(tracked.rms_m / steady);
    tracked.speed_mean_m_per_s /= steady;
  } else if (tracked.trouble.empty()) {
    tracked.trouble = "no steady part";
  }
  return tracked;
}

}  // namespace towbench::harness
