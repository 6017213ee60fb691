// What the controller must find out by itself about its encoders.
#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <vector>

#include <fmt/format.h>

#include "harness/fault_cases/requirements.h"

namespace towbench::harness {
namespace {

using core::Axis;
using core::Nanoseconds;
using enum FaultKind;

// Since when this fault acts, others apart.
Nanoseconds cause_of(const CaseEvidence& evidence, const Fault& fault) {
  const auto& plan = evidence.prepared.plan;
  if (plan.size() == 1) {
    return evidence.cause_ns;
  }
  const auto index = static_cast<std::size_t>(&fault - plan.data());
  return std::max(evidence.cause_ns, evidence.prepared.onsets_ns[index]);
}

// When it is over; what it changed first may have come much later than its onset.
Nanoseconds end_of(const CaseEvidence& evidence, const Fault& fault) {
  const auto index = static_cast<std::size_t>(&fault - evidence.prepared.plan.data());
  return fault.duration_s
             ? evidence.prepared.onsets_ns[index] + core::nanoseconds(*fault.duration_s)
             : kNever;
}

// Whether the axis is not quite the one that the controller was told of: its torque over its
// inertia decides how soon motion that is missing can be missed.
bool differs_from_configuration(const CaseEvidence& evidence, Axis axis) {
  constexpr double kSame = 0.01;
  const auto& plant = evidence.fixture.rig.parameters.axes[axis].plant;
  const auto& told = evidence.fixture.controller.configuration.axes[axis].braking;
  return std::fabs(plant.inertia_kg_m2 / told.inertia_kg_m2 - 1.0) > kSame;
}

// As few illegal transitions as the controller is told to allow are noise, and no fault.
bool is_allowed(const CaseEvidence& evidence, const Fault& fault) {
  constexpr double kWindow_s = 0.020;  // bbmc/system/axis_configuration.h
  constexpr double kClearly = 2;
  const auto& settings =
      evidence.fixture.controller.configuration.axes[fault.place.axis].plausibility;
  return fault.kind == kIllegalTransitions &&
         fault.parameters[0] * kWindow_s <
             kClearly * static_cast<double>(settings.illegal_transitions_max);
}

// A step that no drive can make. A smaller one cannot be told from motion: the index slips with the
// disc.
bool is_beyond_the_drive(const CaseEvidence& evidence, const Fault& jump) {
  const Axis axis = jump.place.axis;
  // The rotor alone, from rest, with the amplifier's peak current: it moves 0.5 a t^2 in an
  // exchange.
  constexpr double kTimes = 10;
  const auto& plant = evidence.prepared.built.axes[axis].plant;
  const double exchange_s = core::seconds(evidence.run.outcome.exchange_ns);
  const double possible_rad = 0.5 * plant.torque_constant_Nm_per_A * plant.current_limit_A /
                              plant.rotor_inertia_kg_m2 * exchange_s * exchange_s;
  const double step_rad = std::fabs(jump.parameters[0]) *
                          evidence.fixture.controller.configuration.axes[axis].rad_per_count();
  return step_rad >= kTimes * possible_rad;
}

// A stretch in which an axis is asked for more than 1.5 times its worst break-away, one way.
struct Push {
  Nanoseconds from_ns = 0;
  Nanoseconds to_ns = 0;
};

// A motor that stands and holds its carriage, which swings on the transmission, does not push: the
// transmission's true pull explains the drive.
bool holds_swing(const CaseEvidence& evidence, Axis axis, Nanoseconds time_ns, double duty,
                 double threshold) {
  constexpr double kStands_rad_per_s = 5.0;
  const auto& settings = evidence.fixture.controller.configuration.axes[axis];
  const auto& truth = evidence.run.truth_at(time_ns).axes[axis];
  const double transmission = truth.transmission_force_N * settings.metres_per_motor_rad() /
                              settings.drive.full_duty_torque_Nm();
  return std::fabs(truth.motor_speed_rad_per_s) < kStands_rad_per_s && transmission * duty > 0 &&
         std::fabs(duty - transmission) < threshold;
}

std::vector<Push> pushes(const CaseEvidence& evidence, Axis axis) {
  constexpr double kAboveBreakaway = 1.5;  // CTL-5: "exceeds ... by half"
  const auto& run = evidence.run;
  const auto& settings = evidence.fixture.controller.configuration.axes[axis];
  const double threshold = kAboveBreakaway * settings.plausibility.worst_breakaway_Nm /
                           settings.drive.full_duty_torque_Nm();
  std::vector<Push> found;
  double sign = 0;
  for (const auto& row : run.log) {
    const auto& state = row.axes[axis];
    const double duty = state.duty_pct / 100.0;
    const bool pushes = is_driven_mode(state.mode) && std::fabs(duty) > threshold &&
                        !holds_swing(evidence, axis, row.time_ns, duty, threshold);
    const double now = pushes ? (duty > 0 ? 1.0 : -1.0) : 0.0;
    if (now != 0 && now != sign) {
      found.push_back({row.time_ns, row.time_ns});
    }
    if (now != 0) {
      found.back().to_ns = row.time_ns;
    }
    sign = now;
  }
  return found;
}

}  // namespace

MaybeCheck encoder_fault_is_found(const CaseEvidence& evidence) {
  constexpr auto kName = "encoder_fault_found";
  constexpr auto kMeaning =
      "encoder: a fault within 50 ms and 5 mm after the drive exceeds break-away by half";
  constexpr double kFarthest_m = 5e-3;
  const Fault* fault = fault_of(evidence, FaultPart::kEncoder);
  if (fault == nullptr || !must_be_found(*fault) || fault->kind == kIndexMissing ||
      is_allowed(evidence, *fault) ||
      (fault->kind == kJump && !is_beyond_the_drive(evidence, *fault))) {
    return std::nullopt;
  }
  const auto& run = evidence.run;
  const auto axis = fault->place.axis;
  // Parameters that are up to 10 % off cost up to 20 % of the time (docs/theory/safety.md).
  const double longest_s = differs_from_configuration(evidence, axis) ? 0.060 : 0.050;
  const auto cause_ns = cause_of(evidence, *fault);
  const auto found_ns = latched_ns(run);
  const auto gone_ns = end_of(evidence, *fault);
  const auto exchange_ns = run.outcome.exchange_ns;
  double most_used = 0;
  for (const Push& push : pushes(evidence, axis)) {
    const auto from_ns = std::max(push.from_ns, cause_ns);
    const auto to_ns = std::min({push.to_ns, found_ns, gone_ns});
    if (to_ns <= from_ns) {
      continue;
    }
    const double time_s = core::seconds(to_ns - from_ns - exchange_ns);
    const double way_m = std::fabs(run.truth_at(to_ns - exchange_ns).axes[axis].carriage_m -
                                   run.truth_at(from_ns).axes[axis].carriage_m);
    const double used = std::max(time_s / longest_s, way_m / kFarthest_m);
    if (used > 1) {
      return with_used(
          failed(kName, kMeaning,
                 fmt::format("driven above that from {:.4f} s for {:.0f} ms and {:.1f} mm{}",
                             core::seconds(from_ns), 1e3 * time_s, 1e3 * way_m,
                             found_ns == kNever ? ", never found" : "")),
          used);
    }
    most_used = std::max(most_used, used);
  }
  return with_used(passed(kName, kMeaning), most_used);
}

MaybeCheck encoder_jump_is_found(const CaseEvidence& evidence) {
  constexpr auto kName = "encoder_jump_found";
  constexpr auto kMeaning =
      "encoder: a step that no drive can make is a fault within 50 ms while driven";
  constexpr Nanoseconds kLongest_ns = 50 * core::kNanosecondsPerMillisecond;
  const Fault* fault = fault_of(evidence, FaultPart::kEncoder);
  if (fault == nullptr || fault->kind != kJump || !is_beyond_the_drive(evidence, *fault)) {
    return std::nullopt;
  }
  const auto cause_ns = cause_of(evidence, *fault);
  if (!is_driven_mode(mode_at(evidence.run, fault->place.axis, cause_ns - 1))) {
    return std::nullopt;
  }
  if (latched_ns(evidence.run) > cause_ns + kLongest_ns) {
    return failed(kName, kMeaning,
                  fmt::format("{:.0f} counts at {:.4f} s, nothing latched 50 ms later",
                              fault->parameters[0], core::seconds(cause_ns)));
  }
  return passed(kName, kMeaning);
}

MaybeCheck lost_index_is_found(const CaseEvidence& evidence) {
  constexpr auto kName = "lost_index_found";
  constexpr auto kMeaning =
      "encoder: a lost index is a fault within 1.1 motor turns of driven motion";
  constexpr double kLongest_rad = 1.1 * 2.0 * std::numbers::pi;
  // The last pulse may have come just before, and the controller hears of motion one exchange late.
  constexpr double kSlack_rad = 0.1 * 2.0 * std::numbers::pi;
  const Fault* fault = fault_of(evidence, FaultPart::kEncoder);
  if (fault == nullptr || fault->kind != kIndexMissing) {
    return std::nullopt;
  }
  const auto& run = evidence.run;
  const auto axis = fault->place.axis;
  const auto found_ns = latched_ns(run);
  const auto cause_ns = cause_of(evidence, *fault);
  const auto gone_ns = end_of(evidence, *fault);
  double lowest = std::numeric_limits<double>::max();
  double highest = -lowest;
  double direction = 0;
  double most_used = 0;
  for (const auto& row : run.truth) {
    if (row.time_ns < cause_ns || row.time_ns > std::min(found_ns, gone_ns)) {
      continue;
    }
    if (!is_driven_mode(mode_at(run, axis, row.time_ns))) {
      lowest = std::numeric_limits<double>::max();
      highest = -lowest;
      continue;
    }
    // One way: who turns back has not yet passed where the pulse should be.
    const double speed = row.axes[axis].motor_speed_rad_per_s;
    if (speed * direction < 0) {
      lowest = highest = row.axes[axis].motor_angle_rad;
    }
    direction = speed;
    lowest = std::min(lowest, row.axes[axis].motor_angle_rad);
    highest = std::max(highest, row.axes[axis].motor_angle_rad);
    const double used = (highest - lowest) / (kLongest_rad + kSlack_rad);
    if (used > 1) {
      return with_used(failed(kName, kMeaning,
                              fmt::format("{:.2f} turns by {:.4f} s",
                                          (highest - lowest) / (2.0 * std::numbers::pi),
                                          core::seconds(row.time_ns))),
                       used);
    }
    most_used = std::max(most_used, used);
  }
  return with_used(passed(kName, kMeaning), most_used);
}

}  // namespace towbench::harness
