// What the controller must find out by itself about amplifiers, link and host, and what it must not
// mistake for a fault.
#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "harness/fault_cases/requirements.h"

namespace towbench::harness {
namespace {

using core::Axis;
using core::ErrorCode;
using core::Nanoseconds;
using enum FaultKind;

bool hall_reached(const CaseRecord& run, Nanoseconds until_ns) {
  return std::any_of(run.lines.begin(), run.lines.end(), [&](const LineArrival& arrival) {
    return arrival.served_ns <= until_ns && (arrival.lines & 0xFU) != 0;
  });
}

}  // namespace

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
  double most_used = 0;
  for (const auto axis : core::kPlanarAxes) {
    const auto ready = protocol::mask_of(protocol::ready_line(axis));
    Nanoseconds bad_since_ns = -1;
    for (const auto& row : run.truth) {
      // At a slow control rate the log still shows a mode that a fault has ended.
      const bool bad = (row.input_lines & ready) == 0 &&
                       is_driven_mode(mode_at(run, axis, row.time_ns)) &&
                       !latched_by(run, row.time_ns);
      bad_since_ns = bad ? (bad_since_ns < 0 ? row.time_ns : bad_since_ns) : -1;
      const double used =
          bad ? core::seconds(row.time_ns - bad_since_ns) / core::seconds(limit_ns) : 0;
      if (used > 1) {
        return with_used(failed(kName, kMeaning,
                                fmt::format("{} driven without a ready amplifier at {:.4f} s",
                                            core::name_of(axis), core::seconds(row.time_ns))),
                         used);
      }
      most_used = std::max(most_used, used);
    }
  }
  return with_used(passed(kName, kMeaning), most_used);
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
  // A clock that leaps ahead by less than a host may be late says nothing wrong.
  constexpr double kHostMayBeLate_s = 0.021;
  if (fault->kind == kClockStep && fault->parameters[0] >= 0 &&
      fault->parameters[0] < kHostMayBeLate_s) {
    return std::nullopt;
  }
  const auto& run = evidence.run;
  // A host that slept beside a machine at rest has missed nothing, however late that shows.
  const auto cause_ns =
      fault == host ? evidence.prepared
                          .onsets_ns[static_cast<std::size_t>(host - evidence.prepared.plan.data())]
                    : evidence.cause_ns;
  const auto seen_ns = served_ns(evidence, cause_ns);
  const bool driven = any_driven_mode(run, cause_ns - 1);
  if (fault == host && seen_ns + kLongest_ns > run.outcome.end_ns) {
    return std::nullopt;  // the record ends before the host has run again for so long
  }
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
  double most_used = 0;
  for (const auto& row : run.log) {
    for (const auto axis : core::kPlanarAxes) {
      const auto& state = row.axes[axis];
      const bool follows =
          state.mode == bbmc::AxisMode::kPosition || state.mode == bbmc::AxisMode::kVelocity;
      const double off_m = follows ? std::fabs(state.reference_m - state.position_m) : 0;
      if (off_m > limit_m) {
        return with_used(failed(kName, kMeaning,
                                fmt::format("{} is {:.1f} mm off at {:.4f} s", core::name_of(axis),
                                            1e3 * off_m, core::seconds(row.time_ns))),
                         off_m / limit_m);
      }
      most_used = std::max(most_used, off_m / limit_m);
    }
  }
  return with_used(passed(kName, kMeaning), most_used);
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
  if (fault != nullptr && evidence.reference.first_fault() == nullptr) {
    return failed(
        kName, kMeaning,
        fmt::format("fault {}: {}", core::number_of(fault->code), core::describe(fault->code)));
  }
  return passed(kName, kMeaning);
}

MaybeCheck bounce_while_leaving_is_ignored(const CaseEvidence& evidence) {
  constexpr auto kName = "leaving_goes_on";
  constexpr auto kMeaning = "a switch that bounces while its end is left does not stop the machine";
  const Fault* fault = fault_of(evidence, FaultPart::kEndStop);
  if (fault == nullptr || fault->kind != kBounce) {
    return std::nullopt;
  }
  const auto& edges = evidence.reference.plant_events;
  const auto line = fault->place.switch_line();
  const auto index = static_cast<std::size_t>(fault - evidence.prepared.plan.data());
  const auto edge = std::find_if(edges.begin(), edges.end(), [&](const auto& event) {
    return event.kind == emulator::PlantEventKind::kInputLineChanged &&
           event.time_ns >= evidence.prepared.onsets_ns[index] &&
           static_cast<protocol::InputLine>(static_cast<int>(event.value)) == line;
  });
  const bool is_left = edge != edges.end() && (edge->lines & protocol::mask_of(line)) == 0;
  if (!is_left || evidence.prepared.plan.size() > 1) {
    return std::nullopt;
  }
  const auto faults_of = [](const CaseRecord& run) {
    return std::count_if(
        run.controller_events.begin(), run.controller_events.end(),
        [](const auto& event) { return event.kind == bbmc::ControllerEvent::Kind::kFaultLatched; });
  };
  if (faults_of(evidence.run) > faults_of(evidence.reference)) {
    return failed(kName, kMeaning, "it was stopped once more than with a sound switch");
  }
  return passed(kName, kMeaning);
}

MaybeCheck fault_number_fits(const CaseEvidence& evidence) {
  constexpr auto kName = "fault_number";
  constexpr auto kMeaning = "what is latched names what happened";
  const auto* latched = evidence.run.first_fault();
  const auto* of_reference = evidence.reference.first_fault();
  const bool same_as_reference =
      latched != nullptr && of_reference != nullptr && latched->code == of_reference->code;
  if (latched == nullptr || same_as_reference) {
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
        // A wrong encoder reading may put the axis anywhere; that it is wrong must still be told.
        fits = fits || between(must_be_found(fault) ? 310 : 303, 315) || number == 350;
        break;
      case FaultPart::kAmplifier:
      case FaultPart::kSupply:
      case FaultPart::kDriveTrain:
        // 351: a drive that does not brake shows at the motion's own end, too.
        fits = fits || between(303, 315) || number == 330 || between(350, 351);
        break;
      case FaultPart::kLink:
        // What a link loses or damages is the link's fault, however it looks further on.
        fits = fits || (must_be_found(fault) ? between(320, 321) : between(303, 350));
        break;
      case FaultPart::kHomeSwitch:
        break;  // BBMC does not read it
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
