#include "study/results/tracked_run.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <memory>

#include <fmt/format.h>

#include "harness/fault_cases/case_run.h"
#include "study/procedures/machine.h"

namespace towbench::study {
namespace {

using core::Axis;

constexpr double kLongestHoming_s = 300;

std::vector<harness::ConsoleStep> find_place(const harness::RigFixture& rig, PlaceKnown place) {
  std::vector<harness::ConsoleStep> steps;
  const auto start_m = [&](Axis axis) { return rig.parameters.axes[axis].start_m; };
  if (place == PlaceKnown::kHomed) {
    steps.push_back(procedures::move("poscalib", kLongestHoming_s));
    steps.push_back(
        procedures::move(fmt::format("goto {:.6f}m {:.6f}m", start_m(Axis::kY), start_m(Axis::kX)),
                         kLongestHoming_s));
    return steps;
  }
  for (const auto axis : core::kPlanarAxes) {
    steps.push_back(procedures::say(
        fmt::format("reset poscalib {} {:.6f}m", core::name_of(axis), start_m(axis))));
  }
  return steps;
}

// One motion from where the rig stands.
std::unique_ptr<harness::CaseRecord> record_of(const harness::RigFixture& rig,
                                               const harness::ControllerFixture& controller,
                                               const std::string& motion, double longest_s,
                                               std::uint64_t seed,
                                               PlaceKnown place = PlaceKnown::kTold) {
  harness::ExperimentFixture fixture;
  fixture.rig = rig;
  fixture.controller = controller;
  fixture.experiment.name = "tracked motion";
  auto& steps = fixture.experiment.console;
  steps = find_place(rig, place);
  steps.push_back(procedures::move(motion, longest_s));
  fixture.experiment.duration_limit_s =
      longest_s + 10 + (place == PlaceKnown::kHomed ? 2 * kLongestHoming_s : 0);
  return harness::run_case(fixture, fixture.rig.parameters, {}, {.seed = seed});
}

// Its first row: what was driven before, to find its place, is none of it.
auto last_motion(const std::vector<harness::LogRow>& log) {
  const auto driven = [](const harness::LogRow& row) {
    return row.axes[Axis::kY].mode == bbmc::AxisMode::kPosition;
  };
  auto at = log.end();
  while (at != log.begin() && !driven(*std::prev(at))) {
    --at;
  }
  while (at != log.begin() && driven(*std::prev(at))) {
    --at;
  }
  return at;
}

std::string trouble_of(const harness::CaseRecord& record) {
  if (const auto* fault = record.first_fault(); fault != nullptr) {
    return std::string(core::describe(fault->code));
  }
  return record.outcome.script_failure;
}

}  // namespace

TrackedRun track_trapezoid(const harness::RigFixture& rig,
                           const harness::ControllerFixture& controller, const TrapezoidRun& run,
                           std::uint64_t seed) {
  const double longest_s = run.distance_m / run.speed_m_per_s + 20;
  const auto record = record_of(
      rig, controller,
      fmt::format("run -trapez y --distance {:.4f}m --speed {:.4f}m/s --acceleration {:.3f}s "
                  "--smooth {:.3f}s",
                  run.distance_m, run.speed_m_per_s, run.acceleration_s, run.smooth_s),
      longest_s, seed, run.place);
  TrackedRun tracked;
  tracked.trouble = trouble_of(*record);
  double steady = 0;
  double followed = 0;
  double steady_from_s = -1;
  for (auto at = last_motion(record->log); at != record->log.end(); ++at) {
    const auto& row = *at;
    const auto& y = row.axes[Axis::kY];
    if (y.mode != bbmc::AxisMode::kPosition) {
      continue;
    }
    const double error = y.reference_m - y.position_m;
    const auto& truth = record->truth_at(row.time_ns).axes[Axis::kY];
    const double carriage = y.reference_m - truth.carriage_m;
    tracked.place_off_m =
        y.position_m - controller.configuration.axes[Axis::kY].position_m(truth.count);
    tracked.peak_m = std::max(tracked.peak_m, std::fabs(error));
    tracked.carriage_peak_m = std::max(tracked.carriage_peak_m, std::fabs(carriage));
    tracked.whole_mean_m += std::fabs(error);
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
    tracked.whole_mean_m /= followed;
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

std::vector<TrackedSpeed> track_speeds(const harness::RigFixture& rig,
                                       const harness::ControllerFixture& controller,
                                       std::span<const double> speeds_m_per_s, TrapezoidRun run,
                                       const SteadyPart& steady) {
  std::vector<TrackedSpeed> all;
  for (const double speed : speeds_m_per_s) {
    run.speed_m_per_s = speed;
    run.distance_m =
        std::min(steady.track_m, speed * (run.acceleration_s + run.smooth_s + steady.longest_s));
    all.push_back({speed, track_trapezoid(rig, controller, run, 1)});
  }
  return all;
}

TrackedCircle track_circle(const harness::RigFixture& rig,
                           const harness::ControllerFixture& controller, std::uint64_t seed) {
  const auto record =
      record_of(rig, controller, "run -circle --radius 0.2m --period 7s --turns 2", 40, seed);
  TrackedCircle tracked;
  tracked.trouble = trouble_of(*record);
  for (const auto axis : core::kPlanarAxes) {
    CircleError& of = tracked.axes[axis];
    double followed = 0;
    double speed_at_peak = 0;
    double top_speed = 0;
    for (const auto& row : record->log) {
      const auto& state = row.axes[axis];
      if (state.mode != bbmc::AxisMode::kPosition) {
        continue;
      }
      const double error = state.reference_m - state.position_m;
      const double speed = std::fabs(state.reference_velocity_m_per_s);
      top_speed = std::max(top_speed, speed);
      followed += 1;
      of.rms_m += error * error;
      if (std::fabs(error) > of.peak_m) {
        of.peak_m = std::fabs(error);
        speed_at_peak = speed;
      }
    }
    if (followed > 0 && top_speed > 0) {
      of.rms_m = std::sqrt(of.rms_m / followed);
      of.speed_share_at_peak = speed_at_peak / top_speed;
    } else if (tracked.trouble.empty()) {
      tracked.trouble = "not driven";
    }
  }
  return tracked;
}

}  // namespace towbench::study
