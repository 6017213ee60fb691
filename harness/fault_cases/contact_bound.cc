// No contact with a hard end that a physically possible reaction could have prevented.
//
// The bound is found by doing it: the same case, fault and all, on the same elastic axis, but from
// the moment at which the controller could have reacted the drive is turned to full reverse, as far
// as the gear may take it, until the carriage stands and the axis as a whole has no momentum
// outwards any more: a carriage that merely swings back on its transmission will come again. For
// two bodies on a spring and damper the carriage answers an impulse on the motor with a
// displacement that is never negative, (t - sin(w t)/w) / m without damping, so that no other
// sequence of torques stops the carriage shorter. If it touches even so, nobody could have
// prevented it.
#include <algorithm>
#include <cmath>
#include <limits>

#include <fmt/format.h>

#include "bbmc/system/stopping_distance.h"
#include "emulator/plant/derived_mechanics.h"
#include "harness/fault_cases/case_run.h"
#include "harness/fault_cases/requirements.h"

namespace towbench::harness {
namespace {

using core::Axis;
using core::Nanoseconds;

constexpr Nanoseconds kBestReaction_ns = 2 * core::kNanosecondsPerMillisecond;
constexpr Nanoseconds kDetection_ns = 50 * core::kNanosecondsPerMillisecond;

struct Contact {
  Axis axis = core::kFirstAxis;
  Nanoseconds time_ns = 0;
  double speed_m_per_s = 0;
  int side = 1;  // +1: max end
};

const Contact* first_contact(const CaseEvidence& evidence, Contact& contact) {
  for (const auto& event : evidence.run.plant_events) {
    if (event.kind != emulator::PlantEventKind::kHardEndContact) {
      continue;
    }
    const auto& ends = evidence.prepared.built.axes[event.axis].plant.hard_ends;
    const double carriage_m = evidence.run.truth_at(event.time_ns).axes[event.axis].carriage_m;
    contact = {.axis = event.axis,
               .time_ns = event.time_ns,
               .speed_m_per_s = std::fabs(event.value),
               .side = carriage_m > 0.5 * (ends.min_m + ends.max_m) ? 1 : -1};
    return &contact;
  }
  return nullptr;
}

// Of an axis to the nearer of its hard ends, the smallest; infinite where it has none.
double nearest_m(const CaseRecord& run, Axis axis, const emulator::HardEndParameters& ends) {
  double nearest = std::numeric_limits<double>::infinity();
  for (const auto& row : run.truth) {
    const double carriage_m = row.axes[axis].carriage_m;
    nearest = std::min({nearest, carriage_m - ends.min_m, ends.max_m - carriage_m});
  }
  return nearest;
}

// How much of the distance that the fault-free run keeps to its ends is used up.
double used_distance(const CaseEvidence& evidence) {
  double used = 0;
  for (const auto axis : core::kPlanarAxes) {
    const auto& ends = evidence.prepared.built.axes[axis].plant.hard_ends;
    if (ends.fitted && evidence.prepared.built.axes[axis].exists) {
      used = std::max(used, 1 - nearest_m(evidence.run, axis, ends) /
                                    nearest_m(evidence.reference, axis, ends));
    }
  }
  return used;
}

// When the controller was in a position to know that the axis had to stop: a switch of that axis
// told it, it latched a fault itself, a wrong encoder reading had to be found, or its own (true)
// position said so. What came before the operator's last reset does not count: the operator has
// allowed to move on. Never: nothing could have told.
Nanoseconds could_know_ns(const CaseEvidence& evidence, const Contact& contact) {
  const auto& run = evidence.run;
  Nanoseconds since_ns = 0;
  for (auto reset_ns = run.next_reset_ns(since_ns); reset_ns < contact.time_ns;
       reset_ns = run.next_reset_ns(since_ns)) {
    since_ns = reset_ns + 1;
  }
  Nanoseconds known_ns = kNever;
  const protocol::InputLines halls = protocol::mask_of(protocol::hall_line(contact.axis, false)) |
                                     protocol::mask_of(protocol::hall_line(contact.axis, true));
  for (const auto& arrival : run.lines) {
    if (arrival.served_ns >= since_ns && (arrival.lines & halls) != 0) {
      known_ns = std::min(known_ns, served_ns(evidence, arrival.served_ns));
      break;
    }
  }
  for (const auto& event : run.controller_events) {
    if (event.kind == bbmc::ControllerEvent::Kind::kFaultLatched && event.time_ns >= since_ns) {
      known_ns = std::min(known_ns, event.time_ns);
    }
  }
  const auto& plan = evidence.prepared.plan;
  const bool encoder_is_wrong = std::any_of(plan.begin(), plan.end(), [](const Fault& fault) {
    return fault.place.part == FaultPart::kEncoder && fault.row().duty == FaultDuty::kStop;
  });
  return encoder_is_wrong
             ? std::min(known_ns, std::max(since_ns, evidence.cause_ns) + kDetection_ns)
             : known_ns;
}

// When the drive is taken away, braking included: a kill demands it, and over a link that is lost
// no command arrives. What a controller gives up on its own account is no excuse.
struct DriveTaken {
  Nanoseconds from_ns = kNever;
  const char* why = "";
};

DriveTaken drive_taken(const CaseEvidence& evidence) {
  constexpr auto kKill = protocol::mask_of(protocol::InputLine::kKillSwitch);
  const auto& run = evidence.run;
  DriveTaken taken;
  for (const auto& arrival : run.lines) {
    if ((arrival.lines & kKill) != 0) {
      taken = {served_ns(evidence, arrival.served_ns) + kBestReaction_ns,
               "by requirement: a kill takes the drive away"};
      break;
    }
  }
  for (const auto& event : run.controller_events) {
    if (event.kind == bbmc::ControllerEvent::Kind::kDutyZeroed && event.time_ns < taken.from_ns &&
        event.code == core::ErrorCode::kFaultLinkLost && has(evidence, FaultPart::kLink)) {
      taken = {event.time_ns, "unavoidable: over a lost link no command arrives"};
    }
  }
  return taken;
}

// When a command that is sent then acts: those before it are on their way, in order, for so long,
// or all are lost for so long.
Nanoseconds arrives_ns(const CaseEvidence& evidence, Nanoseconds sent_ns) {
  const auto& prepared = evidence.prepared;
  auto arrives = sent_ns;
  for (std::size_t i = 0; i < prepared.plan.size(); ++i) {
    const auto& fault = prepared.plan[i];
    const bool is_on_the_way = fault.place.part == FaultPart::kLink && fault.place.to_plant;
    const bool is_late =
        is_on_the_way && (fault.kind == FaultKind::kDelay || fault.kind == FaultKind::kJitter);
    const bool loses_all =
        is_on_the_way && fault.parameters[0] == 1 &&
        (fault.kind == FaultKind::kLoss || fault.kind == FaultKind::kCorruptByte);
    const auto last_ns =
        fault.duration_s ? prepared.onsets_ns[i] + core::nanoseconds(*fault.duration_s) : kNever;
    if (sent_ns < prepared.onsets_ns[i]) {
      continue;
    }
    if (is_late) {
      arrives =
          std::max(arrives, std::min(sent_ns, last_ns) + core::nanoseconds(fault.parameters[0]));
    } else if (loses_all) {
      arrives = std::max(arrives, last_ns);
    }
  }
  return arrives;
}

// As much as gear and transmission may take (App. A, 3.2 N m at the gear's output): a stop that
// breaks the machine is no reaction.
double reverse_duty(const CaseEvidence& evidence, const Contact& contact) {
  const auto& axis = evidence.fixture.controller.configuration.axes[contact.axis];
  return std::min(1.0, bbmc::braking_torque_Nm(axis) / axis.drive.full_duty_torque_Nm());
}

// Of motor and carriage together, towards the end.
double outward_kg_m_per_s(const emulator::AxisParameters& plant, const emulator::AxisTruth& axis,
                          int side) {
  const auto mechanics = emulator::derive(plant);
  return side * (mechanics.motor_inertia_kg_m2 * axis.motor_speed_rad_per_s /
                     mechanics.metres_per_motor_rad +
                 (mechanics.carriage_mass_kg + plant.water_mass_kg) * axis.carriage_speed_m_per_s);
}

bool touches_even_so(const CaseEvidence& evidence, const Contact& contact, Nanoseconds reverse_ns,
                     Nanoseconds until_ns) {
  constexpr double kLongEnough_s = 2.0;  // coasting included
  const auto best =
      run_case(evidence.fixture, evidence.prepared.built, evidence.prepared.injection,
               {.seed = evidence.seed,
                .reverse = FullReverse{contact.axis, reverse_ns, until_ns, -contact.side,
                                       reverse_duty(evidence, contact)},
                .until_s = core::seconds(reverse_ns) + kLongEnough_s});
  const auto& plant = evidence.prepared.built.axes[contact.axis].plant;
  Nanoseconds turned_ns = kNever;
  for (const auto& row : best->truth) {
    const auto& axis = row.axes[contact.axis];
    if (row.time_ns > reverse_ns && contact.side * axis.carriage_speed_m_per_s <= 0 &&
        outward_kg_m_per_s(plant, axis, contact.side) <= 0) {
      turned_ns = row.time_ns;
      break;
    }
  }
  return std::any_of(best->plant_events.begin(), best->plant_events.end(), [&](const auto& event) {
    return event.kind == emulator::PlantEventKind::kHardEndContact && event.axis == contact.axis &&
           event.time_ns <= turned_ns;
  });
}

}  // namespace

Check no_preventable_contact(const CaseEvidence& evidence) {
  constexpr auto kName = "no_preventable_contact";
  constexpr auto kMeaning =
      "no contact with a hard end that a physically possible reaction could have prevented";
  Contact contact;
  if (first_contact(evidence, contact) == nullptr) {
    return with_used(passed(kName, kMeaning), used_distance(evidence));
  }
  auto unavoidable = passed(kName, kMeaning);
  unavoidable.value = contact.speed_m_per_s;
  unavoidable.unit = "m/s";
  // What the controller did before the fault began did no harm: the reference run touches nothing.
  // A host that does not run reacts when it runs again.
  const auto known_ns =
      served_ns(evidence, std::max(could_know_ns(evidence, contact), evidence.cause_ns));
  if (known_ns == kNever || known_ns + kBestReaction_ns >= contact.time_ns) {
    unavoidable.reason = "unavoidable: nothing told a running controller in time";
    return unavoidable;
  }
  const auto reverse_ns = arrives_ns(evidence, known_ns + kBestReaction_ns);
  if (reverse_ns >= contact.time_ns) {
    unavoidable.reason = "unavoidable: no command arrives in time";
    return unavoidable;
  }
  const auto taken = drive_taken(evidence);
  if (touches_even_so(evidence, contact, reverse_ns, taken.from_ns)) {
    unavoidable.reason = taken.from_ns < contact.time_ns
                             ? fmt::format("{}; full reverse until then touches too", taken.why)
                             : "unavoidable: full reverse from the first evidence on touches too";
    return unavoidable;
  }
  auto check = failed(kName, kMeaning,
                      fmt::format("{} touched at {:.4f} s with {:.3f} m/s; full reverse from "
                                  "{:.4f} s on would have prevented it",
                                  core::name_of(contact.axis), core::seconds(contact.time_ns),
                                  contact.speed_m_per_s, core::seconds(reverse_ns)));
  check.value = contact.speed_m_per_s;
  check.unit = "m/s";
  return check;
}

}  // namespace towbench::harness
