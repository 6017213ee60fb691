// What the controller must find out by itself, and what it must not mistake for a fault.
#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <vector>

#include <fmt/format.h>

#include "harness/faults/requirements.h"

namespace towbench::harness {
namespace {

using core::Axis;
using core::ErrorCode;
using core::Nanoseconds;
using enum FaultKind;

constexpr Nanoseconds kNever = std::numeric_limits<Nanoseconds>::max();

Nanoseconds latched_ns(const CaseRecord& run) {
  const auto* fault = run.first_fault();
  return fault == nullptr ? kNever : fault->time_ns;
}

// The only fault of the plan of that part, with when it begins; null when there is none.
const Fault* fault_of(const CaseEvidence& evidence, FaultPart part) {
  const auto& plan = evidence.prepared.plan;
  const auto found = std::find_if(plan.begin(), plan.end(),
                                  [&](const Fault& fault) { return fault.place.part == part; });
  return found == plan.end() ? nullptr : &*found;
}

bool must_be_found(const Fault& fault) {
  return fault.row().duty == FaultDuty::kStop;
}

// A stretch in which an axis is asked for more than 1.5 times its worst break-away, one way.
struct Push {
  Nanoseconds from_ns = 0;
  Nanoseconds to_ns = 0;
};

// A motor that stands and holds its carriage, which swings on the chain, does not push: the chain's
// true pull explains the drive.
bool holds_swing(const CaseEvidence& evidence, Axis axis, Nanoseconds time_ns, double duty,
                 double threshold) {
  constexpr double kStands_rad_per_s = 5.0;
  const auto& settings = evidence.fixture.controller.configuration.axes[axis];
  const auto& truth = evidence.run.truth_at(time_ns).axes[axis];
  const double chain =
      truth.chain_force_N * settings.m_per_rad() / settings.drive.full_duty_torque_Nm();
  return std::fabs(truth.motor_speed_rad_per_s) < kStands_rad_per_s && chain * duty > 0 &&
         std::fabs(duty - chain) < threshold;
}

std::vector<Push> pushes(const CaseEvidence& evidence, Axis axis) {
  constexpr double kAboveBreakaway = 1.5;  // controller.md 5: "exceeds ... by half"
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

bool hall_reached(const CaseRecord& run, Nanoseconds until_ns) {
  return std::any_of(run.lines.begin(), run.lines.end(), [&](const LineArrival& arrival) {
    return arrival.served_ns <= until_ns && (arrival.lines & 0xFU) != 0;
  });
}

}  // namespace

MaybeCheck encoder_fault_is_found(const CaseEvidence& evidence) {
  constexpr auto kName = "encoder_fault_found";
  constexpr auto kMeaning =
      "encoder: a fault within 50 ms and 5 mm after the drive exceeds break-away by half";
  constexpr double kLongest_s = 0.050;
  constexpr double kFarthest_m = 5e-3;
  const Fault* fault = fault_of(evidence, FaultPart::kEncoder);
  if (fault == nullptr || !must_be_found(*fault) || fault->kind == kIndexMissing) {
    return std::nullopt;
  }
  const auto& run = evidence.run;
  const auto axis = fault->place.axis;
  const auto found_ns = latched_ns(run);
  const auto gone_ns =
      fault->duration_s ? evidence.cause_ns + core::nanoseconds(*fault->duration_s) : kNever;
  const auto exchange_ns = run.outcome.exchange_ns;
  for (const Push& push : pushes(evidence, axis)) {
    const auto from_ns = std::max(push.from_ns, evidence.cause_ns);
    const auto to_ns = std::min({push.to_ns, found_ns, gone_ns});
    if (to_ns <= from_ns) {
      continue;
    }
    const double time_s = core::seconds(to_ns - from_ns - exchange_ns);
    const double way_m = std::fabs(run.truth_at(to_ns - exchange_ns).axes[axis].carriage_m -
                                   run.truth_at(from_ns).axes[axis].carriage_m);
    if (time_s > kLongest_s || way_m > kFarthest_m) {
      return failed(kName, kMeaning,
                    fmt::format("driven above that from {:.4f} s for {:.0f} ms and {:.1f} mm{}",
                                core::seconds(from_ns), 1e3 * time_s, 1e3 * way_m,
                                found_ns == kNever ? ", never found" : ""));
    }
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
  const auto gone_ns =
      fault->duration_s ? evidence.cause_ns + core::nanoseconds(*fault->duration_s) : kNever;
  double lowest = std::numeric_limits<double>::max();
  double highest = -lowest;
  double direction = 0;
  for (const auto& row : run.truth) {
    if (row.time_ns < evidence.cause_ns || row.time_ns > std::min(found_ns, gone_ns)) {
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
    if (highest - lowest > kLongest_rad + kSlack_rad) {
      return failed(
          kName, kMeaning,
          fmt::format("{:.2f} turns by {:.4f} s", (highest - lowest) / (2.0 * std::numbers::pi),
                      core::seconds(row.time_ns)));
    }
  }
  return passed(kName, kMeaning);
}

MaybeCheck amplifier_fault_is_found(const CaseEvidence& evidence) {
  constexpr auto kName = "amplifier_fault_found";
  constexpr auto kMeaning = "an amplifier that is not ready for 0.1 s while driven is a fault";
  const auto& run = evidence.run;
  const auto limit_ns = core::nanoseconds(
      evidence.fixture.controller.configuration.safety.amplifier_ready_timeout_s + 2e-3);
  const Fault* fault = fault_of(evidence, FaultPart::kAmplifier);
  const bool applies =
      has(evidence, FaultPart::kSupply) ||
      (fault != nullptr && (fault->kind == kDisabled || fault->kind == kOverTemperature));
  if (!applies) {
    return std::nullopt;
  }
  for (const auto axis : core::kAxes) {
    const auto ready = protocol::mask_of(axis == Axis::kY ? protocol::InputLine::kAmplifierReadyY
                                                          : protocol::InputLine::kAmplifierReadyX);
    Nanoseconds bad_since_ns = -1;
    for (const auto& row : run.truth) {
      const bool bad =
          (row.input_lines & ready) == 0 && is_driven_mode(mode_at(run, axis, row.time_ns));
      bad_since_ns = bad ? (bad_since_ns < 0 ? row.time_ns : bad_since_ns) : -1;
      if (bad && row.time_ns - bad_since_ns > limit_ns) {
        return failed(kName, kMeaning,
                      fmt::format("{} driven without a ready amplifier at {:.4f} s",
                                  core::name_of(axis), core::seconds(row.time_ns)));
      }
    }
  }
  return passed(kName, kMeaning);
}

MaybeCheck link_or_host_fault_is_found(const CaseEvidence& evidence) {
  constexpr auto kName = "lost_contact_found";
  constexpr auto kMeaning = "a gap between controller and machine while driven is a fault in 25 ms";
  constexpr Nanoseconds kLongest_ns = 25 * core::kNanosecondsPerMillisecond;
  const Fault* link = fault_of(evidence, FaultPart::kLink);
  const Fault* host = fault_of(evidence, FaultPart::kHost);
  const Fault* fault = link != nullptr ? link : host;
  if (fault == nullptr || !must_be_found(*fault)) {
    return std::nullopt;
  }
  const auto& run = evidence.run;
  const auto seen_ns = served_ns(evidence, evidence.cause_ns);
  const bool driven = is_driven_mode(mode_at(run, Axis::kY, evidence.cause_ns - 1)) ||
                      is_driven_mode(mode_at(run, Axis::kX, evidence.cause_ns - 1));
  if (driven && latched_ns(run) > seen_ns + kLongest_ns) {
    return failed(
        kName, kMeaning,
        fmt::format("seen at {:.4f} s, nothing latched 25 ms later", core::seconds(seen_ns)));
  }
  return passed(kName, kMeaning);
}

MaybeCheck tracking_is_guarded(const CaseEvidence& evidence) {
  constexpr auto kName = "tracking_guarded";
  constexpr auto kMeaning =
      "no motor further from its reference than the tracking limit while driven";
  constexpr double kSlack_m = 3e-3;  // two control ticks at top speed
  if (has(evidence, FaultPart::kEncoder)) {
    return std::nullopt;  // what the controller cannot see it cannot guard; other rules hold there
  }
  const auto& run = evidence.run;
  const double limit_m =
      evidence.fixture.controller.configuration.safety.tracking_error_limit_m + kSlack_m;
  for (const auto& row : run.log) {
    for (const auto axis : core::kAxes) {
      const auto& state = row.axes[axis];
      const bool follows =
          state.mode == bbmc::AxisMode::kPosition || state.mode == bbmc::AxisMode::kVelocity;
      if (follows && std::fabs(state.reference_m - state.position_m) > limit_m) {
        return failed(kName, kMeaning,
                      fmt::format("{} is {:.1f} mm off at {:.4f} s", core::name_of(axis),
                                  1e3 * std::fabs(state.reference_m - state.position_m),
                                  core::seconds(row.time_ns)));
      }
    }
  }
  return passed(kName, kMeaning);
}

MaybeCheck no_false_trip(const CaseEvidence& evidence) {
  constexpr auto kName = "no_false_trip";
  constexpr auto kMeaning = "the machine goes on: this is no reason to stop it";
  const auto& plan = evidence.prepared.plan;
  const bool harmless = std::all_of(plan.begin(), plan.end(), [](const Fault& fault) {
    return fault.row().duty == FaultDuty::kNoTrip;
  });
  const auto* fault = evidence.run.first_fault();
  if (!harmless) {
    return std::nullopt;
  }
  if (fault != nullptr && evidence.twin.first_fault() == nullptr) {
    return failed(
        kName, kMeaning,
        fmt::format("fault {}: {}", core::number_of(fault->code), core::describe(fault->code)));
  }
  return passed(kName, kMeaning);
}

MaybeCheck fault_number_fits(const CaseEvidence& evidence) {
  constexpr auto kName = "fault_number";
  constexpr auto kMeaning = "what is latched names what happened";
  const auto* latched = evidence.run.first_fault();
  const auto* of_twin = evidence.twin.first_fault();
  const bool same_as_twin =
      latched != nullptr && of_twin != nullptr && latched->code == of_twin->code;
  if (latched == nullptr || same_as_twin) {
    return std::nullopt;
  }
  const auto number = core::number_of(latched->code);
  const auto between = [&](int low, int high) { return number >= low && number <= high; };
  // A machine that is stopped by where it is, how fast, or how far off, says just that.
  bool fits = hall_reached(evidence.run, latched->time_ns) && between(301, 302);
  for (const auto& fault : evidence.prepared.plan) {
    switch (fault.place.part) {
      case FaultPart::kKillSwitch:
        fits = fits || number == 300;
        break;
      case FaultPart::kEndStop:
        // A switch that says nothing lets the carriage run on until something else is found.
        fits = fits || between(301, 303) ||
               (fault.row().duty == FaultDuty::kNothing && (between(303, 315) || number == 350));
        break;
      case FaultPart::kEncoder:
        fits = fits || between(303, 315) || number == 350;
        break;
      case FaultPart::kAmplifier:
      case FaultPart::kSupply:
      case FaultPart::kDriveTrain:
        fits = fits || between(303, 315) || number == 330 || number == 350;
        break;
      case FaultPart::kLink:
      case FaultPart::kHost:
        fits = fits || between(303, 350);
        break;
    }
  }
  if (fits) {
    return passed(kName, kMeaning);
  }
  return failed(kName, kMeaning,
                fmt::format("fault {}: {}", number, core::describe(latched->code)));
}

}  // namespace towbench::harness
