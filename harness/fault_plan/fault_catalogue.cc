#include "harness/fault_plan/fault_catalogue.h"

#include <algorithm>
#include <iterator>

#include "core/check.h"

namespace towbench::harness {
namespace {

using enum FaultPart;
using enum FaultKind;
using enum FaultStart;
using enum FaultDuty;

constexpr FaultNeeds kNone = FaultNeeds::kNothing;

// clang-format off
constexpr FaultRow kRows[] = {
    {kEndStop, kStuckOpen, "stuck_open", "the line stays inactive", kAnyTime, kNothing, kNone, {}},
    {kEndStop, kStuckClosed, "stuck_closed", "the line stays active", kAnyTime, kStop, kNone, {}},
    {kEndStop, kBounce, "bounce", "the contact's next edge bounces", kAnyTime, kStop, kNone,
     {{{"bounces", 5, 1, 40}, {"within_s", 5e-3, 1e-4, 0.1}}}},
    {kEndStop, kLate, "late", "the line follows its sensor late", kWholeRun, kStop, kNone,
     {{{"delay_s", 2e-3, 1e-4, 0.1}}}},
    {kEndStop, kMissing, "missing", "the sensor is not there", kWholeRun, kNothing, kNone, {}},
    {kEndStop, kSwappedEnds, "swapped_ends", "min and max of the axis exchanged", kAnyTime, kStop, kNone, {}},
    {kEndStop, kSwappedAxes, "swapped_axes", "exchanged with the same end of the other axis", kAnyTime, kStop, kNone, {}},
    {kEndStop, kDisplaced, "displaced", "mounted elsewhere, + towards max", kWholeRun, kStop, kNone,
     {{{"by_m", -0.02, -4, 4}}}},
    {kEndStop, kLatching, "latching", "latches where switching is expected", kWholeRun, kStop, kNone, {}},
    {kEndStop, kBrokenWire, "broken_wire", "reads inactive, or active with reads_active = 1", kAnyTime, kNothing, kNone,
     {{{"reads_active", 0, 0, 1}}}},

    {kKillSwitch, kPressed, "pressed", "pressed, and held for the duration", kAnyTime, kStop, kNone, {}},
    {kKillSwitch, kBounce, "bounce", "pressed, and the contact bounces", kAnyTime, kStop, kNone,
     {{{"bounces", 5, 1, 40}, {"within_s", 5e-3, 1e-4, 0.1}}}},
    {kKillSwitch, kWelded, "welded", "pressed 50 ms later, but the contact does not open", kAnyTime, kNothing, kNone, {}},
    {kKillSwitch, kReleased, "released_without_reset", "pressed and let go of again", kAnyTime, kStop, kNone,
     {{{"after_s", 0.05, 1e-3, 10}}}},
    {kKillSwitch, kBrokenWire, "broken_wire", "a normally closed contact: a broken wire reads pressed", kAnyTime, kStop, kNone, {}},

    {kEncoder, kDeadA, "dead_a", "channel A stays at a level", kAnyTime, kStop, kNone, {{{"level", 0, 0, 1}}}},
    {kEncoder, kDeadB, "dead_b", "channel B stays at a level", kAnyTime, kStop, kNone, {{{"level", 0, 0, 1}}}},
    {kEncoder, kIndexMissing, "index_missing", "no index pulse", kAnyTime, kStop, kNone, {}},
    {kEncoder, kExtraEdges, "extra_edges", "short pulses on A at random times", kAnyTime, kNothing, kNone,
     {{{"rate_Hz", 2000, 1, 20000}, {"width_s", 2e-6, 1e-7, 4e-5}}}},
    {kEncoder, kMissingEdges, "missing_edges", "A drops out for a moment at random times", kAnyTime, kNothing, kNone,
     {{{"rate_Hz", 200, 1, 5000}, {"width_s", 5e-5, 1e-6, 1e-4}}}},
    {kEncoder, kIllegalTransitions, "illegal_transitions", "A and B change at once", kAnyTime, kStop, kNone,
     {{{"rate_Hz", 1000, 1, 10000}}}},
    {kEncoder, kSwappedChannels, "swapped", "channels A and B exchanged", kAnyTime, kStop, kNone, {}},
    {kEncoder, kInverted, "inverted", "channel A's pair exchanged: counts backwards", kAnyTime, kStop, kNone, {}},
    {kEncoder, kFrozen, "frozen", "no channel changes any more, nor what an absolute encoder tells", kAnyTime, kStop, kNone, {}},
    {kEncoder, kJump, "jump", "the disc jumps", kAnyTime, kStop, kNone, {{{"counts", 400, -100000, 100000}}}},
    {kEncoder, kSlip, "slip", "the disc stands while the shaft turns so far", kAnyTime, kNothing, kNone,
     {{{"counts", 800, 1, 1e7}}}},
    {kEncoder, kNoiseBurst, "noise_burst", "short pulses on A, B and index", kAnyTime, kStop, kNone,
     {{{"rate_Hz", 15000, 100, 30000}, {"width_s", 1e-6, 1e-7, 2e-5}}}},
    {kEncoder, kPhase, "phase", "outside the data sheet's 90 +- 45 deg", kWholeRun, kNoTrip, kNone,
     {{{"phase_deg", 30, 20, 160}}}},

    {kAmplifier, kDisabled, "disabled", "no output, ready line inactive", kAnyTime, kStop, kNone, {}},
    {kAmplifier, kStuckDuty, "stuck_duty", "the command stays what it is", kAnyTime, kNothing, kNone, {}},
    {kAmplifier, kSaturatedEarly, "saturated_early", "the command is limited", kAnyTime, kNothing, kNone,
     {{{"limit_V", 0.5, 0, 50}}}},
    {kAmplifier, kGainDrop, "gain_drop", "the command is scaled", kAnyTime, kNothing, kNone, {{{"ratio", 0.3, 0, 1}}}},
    {kAmplifier, kOverTemperature, "over_temperature", "cuts out, and says so on its ready line", kAnyTime, kStop, kNone, {}},
    {kAmplifier, kInverted, "inverted", "output of the wrong sign", kAnyTime, kStop, kNone, {}},
    {kAmplifier, kBothChannels, "both_channels", "both PWM channels active: drives nothing", kAnyTime, kNothing, kNone, {}},

    {kSupply, kOverCurrent, "over_current", "somebody else's load; the protection opens", kAnyTime, kStop, kNone,
     {{{"power_W", 80, 1, 1000}}}},
    {kSupply, kSag, "sag", "the source loses voltage", kAnyTime, kStop, kNone, {{{"lost_V", 1.0, 0.01, 12}}}},

    {kDriveTrain, kToothSkip, "tooth_skip", "the transmission jumps a tooth, the motor gets ahead", kAnyTime, kNothing,
     kNone, {{{"by_m", 8e-3, -0.04, 0.04}}}},
    {kDriveTrain, kBacklash, "growing_backlash", "the gear's play has grown so far (in months, not in a run)", kWholeRun,
     kNothing, kNone, {{{"play_deg", 1.0, 0.05, 10}}}},
    {kDriveTrain, kJam, "jam", "the carriage is held where it is", kAnyTime, kNothing, kNone, {}},
    {kDriveTrain, kDroppedLoad, "dropped_load", "the carriage is lighter by a load that fell", kAnyTime, kNoTrip, kNone,
     {{{"mass_kg", 0.4, 0.01, 2}}}},
    {kDriveTrain, kBrakeDrag, "brake_drag", "something rubs on the carriage", kAnyTime, kNothing, kNone,
     {{{"force_N", 10, 0.1, 500}}}},
    {kDriveTrain, kObstacle, "obstacle", "something stands in the way, so far ahead (+ towards max)", kAnyTime, kNothing, kNone,
     {{{"ahead_m", 0.05, -4, 4}}}},
    {kDriveTrain, kBrakeStuck, "brake_stuck", "the holding brake closes and does not release: its coil is dead", kAnyTime, kNothing,
     FaultNeeds::kHoldingBrake, {}},
    {kDriveTrain, kBrakeLost, "brake_lost", "the holding brake does not hold", kAnyTime, kNothing,
     FaultNeeds::kHoldingBrake, {}},

    {kLink, kLoss, "loss", "messages are lost", kAnyTime, kStop, kNone, {{{"probability", 0.05, 1e-6, 1}}}},
    {kLink, kDelay, "delay", "messages come late, in order", kAnyTime, kNothing, kNone, {{{"delay_s", 5e-3, 1e-4, 10}}}},
    {kLink, kJitter, "jitter", "messages come late by up to so much, in order", kAnyTime, kNothing, kNone,
     {{{"delay_s", 5e-3, 1e-4, 10}}}},
    {kLink, kDuplicate, "duplicate", "messages come twice", kAnyTime, kNothing, kNone, {{{"probability", 0.05, 1e-6, 1}}}},
    {kLink, kReorder, "reorder", "a message comes behind the next of its kind", kAnyTime, kStop, kNone,
     {{{"probability", 0.05, 1e-6, 1}}}},
    {kLink, kCorruptByte, "corrupt_byte", "one bit of a message's frame flips", kAnyTime, kStop, kNone,
     {{{"probability", 0.05, 1e-6, 1}}}},
    {kLink, kBaudMismatch, "baud_mismatch", "the receiver's baud rate is so many times the sender's", kAnyTime, kStop, kNone,
     {{{"ratio", 0.5, 0.05, 8}}}},
    {kLink, kBusOff, "bus_off", "the controller's node leaves the CAN bus", kAnyTime, kStop, kNone, {}},
    {kLink, kPeerRestart, "peer_restart", "the plant is gone and starts anew", kAnyTime, kStop, kNone, {}},
    {kLink, kPeerKilled, "peer_killed", "the plant is gone", kAnyTime, kStop, kNone, {}},
    {kLink, kFlood, "flood", "so many measurement messages an exchange more", kAnyTime, kNoTrip, kNone,
     {{{"messages", 200, 1, 100000}}}},

    {kHost, kLateTick, "late_tick", "the controller is served late once", kAnyTime, kNoTrip, kNone,
     {{{"delay_s", 2e-3, 1e-3, 0.02}}}},
    {kHost, kMissedTicks, "missed_ticks", "control ticks are missed", kAnyTime, kNothing, kNone,
     {{{"ticks", 10, 1, 10000}}}},
    {kHost, kClockStep, "clock_step", "the controller's clock is off by so much", kAnyTime, kStop, kNone,
     {{{"step_s", 0.1, -10, 10}}}},
    {kHost, kStoppedProcess, "stopped_process", "the controller does not run for a while", kAnyTime, kStop, kNone,
     {{{"length_s", 0.2, 0.03, 10}}}},
    {kHost, kFullDisk, "full_disk", "no file of the record can grow any more", kAnyTime, kNoTrip, FaultNeeds::kRecord, {}},
    {kHost, kKilledWhileLogging, "killed_while_logging", "the controller's process is killed", kAnyTime, kNothing,
     FaultNeeds::kRecord, {}},

    {kHomeSwitch, kStuckOpen, "stuck_open", "the line stays inactive", kAnyTime, kNothing, FaultNeeds::kHomeSwitch, {}},
    {kHomeSwitch, kStuckClosed, "stuck_closed", "the line stays active", kAnyTime, kNothing, FaultNeeds::kHomeSwitch, {}},
    {kHomeSwitch, kBounce, "bounce", "the contact's next edge bounces", kAnyTime, kNothing, FaultNeeds::kHomeSwitch,
     {{{"bounces", 5, 1, 40}, {"within_s", 5e-3, 1e-4, 0.1}}}},
    {kHomeSwitch, kLate, "late", "the line follows its switch late", kWholeRun, kNothing, FaultNeeds::kHomeSwitch,
     {{{"delay_s", 2e-3, 1e-4, 0.1}}}},
    {kHomeSwitch, kMissing, "missing", "the switch is not there", kWholeRun, kNothing, FaultNeeds::kHomeSwitch, {}},
    {kHomeSwitch, kDisplaced, "displaced", "mounted elsewhere, + towards max", kWholeRun, kNothing, FaultNeeds::kHomeSwitch,
     {{{"by_m", -0.02, -4, 4}}}},
    {kHomeSwitch, kBrokenWire, "broken_wire", "reads inactive, or active with reads_active = 1", kAnyTime, kNothing,
     FaultNeeds::kHomeSwitch, {{{"reads_active", 0, 0, 1}}}},
};
// clang-format on

}  // namespace

std::span<const FaultRow> fault_catalogue() noexcept {
  return kRows;
}

const FaultRow* find_fault(FaultPart part, std::string_view kind) noexcept {
  const auto* found = std::find_if(std::begin(kRows), std::end(kRows), [&](const FaultRow& row) {
    return row.part == part && row.name == kind;
  });
  return found == std::end(kRows) ? nullptr : found;
}

const FaultRow& row_of(FaultPart part, FaultKind kind) noexcept {
  const auto* found = std::find_if(std::begin(kRows), std::end(kRows), [&](const FaultRow& row) {
    return row.part == part && row.kind == kind;
  });
  core::check(found != std::end(kRows));
  return *found;
}

std::string_view name_of(FaultPart part) noexcept {
  constexpr std::array<std::string_view, 9> kNames{"end-stop",  "kill switch", "encoder",
                                                   "amplifier", "supply",      "drive train",
                                                   "link",      "host",        "home switch"};
  return kNames[static_cast<std::size_t>(part)];
}

}  // namespace towbench::harness
