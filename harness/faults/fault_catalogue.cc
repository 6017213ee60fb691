#include "harness/faults/fault_catalogue.h"

#include <algorithm>
#include <iterator>

#include "core/check.h"

namespace towbench::harness {
namespace {

using enum FaultPart;
using enum FaultKind;
using enum FaultStart;
using enum FaultDuty;

constexpr std::string_view kNeedsWire =
    "the lockstep loopback has no bits on a wire; it needs a serial or CAN carrier";

// clang-format off
constexpr FaultRow kRows[] = {
    {kEndStop, kStuckOpen, "stuck_open", "the line stays inactive", kAnyTime, kNothing, {}, {}},
    {kEndStop, kStuckClosed, "stuck_closed", "the line stays active", kAnyTime, kStop, {}, {}},
    {kEndStop, kBounce, "bounce", "the contact's next edge bounces", kAnyTime, kStop, {},
     {{{"bounces", 5, 1, 40}, {"within_s", 5e-3, 1e-4, 0.1}}}},
    {kEndStop, kLate, "late", "the line follows its sensor late", kWholeRun, kStop, {},
     {{{"delay_s", 2e-3, 1e-4, 0.1}}}},
    {kEndStop, kMissing, "missing", "the sensor is not there", kWholeRun, kNothing, {}, {}},
    {kEndStop, kSwappedEnds, "swapped_ends", "min and max of the axis exchanged", kAnyTime, kStop, {}, {}},
    {kEndStop, kSwappedAxes, "swapped_axes", "exchanged with the same end of the other axis", kAnyTime, kStop, {}, {}},
    {kEndStop, kDisplaced, "displaced", "mounted elsewhere, + towards max", kWholeRun, kStop, {},
     {{{"by_m", -0.02, -4, 4}}}},
    {kEndStop, kLatching, "latching", "latches where switching is expected", kWholeRun, kStop, {}, {}},
    {kEndStop, kBrokenWire, "broken_wire", "reads inactive, or active with reads_active = 1", kAnyTime, kNothing, {},
     {{{"reads_active", 0, 0, 1}}}},

    {kKillSwitch, kPressed, "pressed", "pressed, and held for the duration", kAnyTime, kStop, {}, {}},
    {kKillSwitch, kBounce, "bounce", "pressed, and the contact bounces", kAnyTime, kStop, {},
     {{{"bounces", 5, 1, 40}, {"within_s", 5e-3, 1e-4, 0.1}}}},
    {kKillSwitch, kWelded, "welded", "pressed 50 ms later, but the contact does not open", kAnyTime, kNothing, {}, {}},
    {kKillSwitch, kReleased, "released_without_reset", "pressed and let go of again", kAnyTime, kStop, {},
     {{{"after_s", 0.05, 1e-3, 10}}}},
    {kKillSwitch, kBrokenWire, "broken_wire", "a normally closed contact: a broken wire reads pressed", kAnyTime, kStop, {}, {}},

    {kEncoder, kDeadA, "dead_a", "channel A stays at a level", kAnyTime, kStop, {}, {{{"level", 0, 0, 1}}}},
    {kEncoder, kDeadB, "dead_b", "channel B stays at a level", kAnyTime, kStop, {}, {{{"level", 0, 0, 1}}}},
    {kEncoder, kIndexMissing, "index_missing", "no index pulse", kAnyTime, kStop, {}, {}},
    {kEncoder, kExtraEdges, "extra_edges", "short pulses on A at random times", kAnyTime, kNothing, {},
     {{{"rate_Hz", 2000, 1, 20000}, {"width_s", 2e-6, 1e-7, 4e-5}}}},
    {kEncoder, kMissingEdges, "missing_edges", "A drops out for a moment at random times", kAnyTime, kNothing, {},
     {{{"rate_Hz", 200, 1, 5000}, {"width_s", 5e-5, 1e-6, 1e-4}}}},
    {kEncoder, kIllegalTransitions, "illegal_transitions", "A and B change at once", kAnyTime, kStop, {},
     {{{"rate_Hz", 1000, 1, 10000}}}},
    {kEncoder, kSwappedChannels, "swapped", "channels A and B exchanged", kAnyTime, kStop, {}, {}},
    {kEncoder, kInverted, "inverted", "channel A's pair exchanged: counts backwards", kAnyTime, kStop, {}, {}},
    {kEncoder, kFrozen, "frozen", "no channel changes any more", kAnyTime, kStop, {}, {}},
    {kEncoder, kJump, "jump", "the disc jumps", kAnyTime, kStop, {}, {{{"counts", 400, -100000, 100000}}}},
    {kEncoder, kSlip, "slip", "the disc stands while the shaft turns so far", kAnyTime, kNothing, {},
     {{{"counts", 800, 1, 1e7}}}},
    {kEncoder, kNoiseBurst, "noise_burst", "short pulses on A, B and index", kAnyTime, kStop, {},
     {{{"rate_Hz", 15000, 100, 30000}, {"width_s", 1e-6, 1e-7, 2e-5}}}},
    {kEncoder, kPhase, "phase", "outside the data sheet's 90 +- 45 deg", kWholeRun, kNoTrip, {},
     {{{"phase_deg", 30, 20, 160}}}},

    {kAmplifier, kDisabled, "disabled", "no output, ready line inactive", kAnyTime, kStop, {}, {}},
    {kAmplifier, kStuckDuty, "stuck_duty", "the command stays what it is", kAnyTime, kNothing, {}, {}},
    {kAmplifier, kSaturatedEarly, "saturated_early", "the command is limited", kAnyTime, kNothing, {},
     {{{"limit_V", 0.5, 0, 50}}}},
    {kAmplifier, kGainDrop, "gain_drop", "the command is scaled", kAnyTime, kNothing, {}, {{{"ratio", 0.3, 0, 1}}}},
    {kAmplifier, kOverTemperature, "over_temperature", "cuts out, and says so on its ready line", kAnyTime, kStop, {}, {}},
    {kAmplifier, kInverted, "inverted", "output of the wrong sign", kAnyTime, kStop, {}, {}},
    {kAmplifier, kBothChannels, "both_channels", "both PWM channels active: drives nothing", kAnyTime, kNothing, {}, {}},

    {kSupply, kOverCurrent, "over_current", "somebody else's load; the protection opens", kAnyTime, kStop, {},
     {{{"power_W", 80, 1, 1000}}}},
    {kSupply, kSag, "sag", "the source loses voltage", kAnyTime, kStop, {}, {{{"lost_V", 1.0, 0.01, 12}}}},

    {kDriveTrain, kChainSkip, "chain_skip", "the chain jumps over its sprocket, the motor gets ahead", kAnyTime, kNothing,
     {}, {{{"by_m", 8e-3, -0.01, 0.01}}}},
    {kDriveTrain, kBacklash, "growing_backlash", "the gear's play has grown so far (in months, not in a run)", kWholeRun,
     kNothing, {}, {{{"play_deg", 1.0, 0.05, 10}}}},
    {kDriveTrain, kJam, "jam", "the carriage is held where it is", kAnyTime, kNothing, {}, {}},
    {kDriveTrain, kDroppedLoad, "dropped_load", "the carriage is lighter by a load that fell", kAnyTime, kNoTrip, {},
     {{{"mass_kg", 0.4, 0.01, 2}}}},
    {kDriveTrain, kBrakeDrag, "brake_drag", "something rubs on the carriage", kAnyTime, kNothing, {},
     {{{"force_N", 10, 0.1, 500}}}},
    {kDriveTrain, kObstacle, "obstacle", "something stands in the way, so far ahead (+ towards max)", kAnyTime, kNothing, {},
     {{{"ahead_m", 0.05, -4, 4}}}},

    {kLink, kLoss, "loss", "messages are lost", kAnyTime, kStop, {}, {{{"probability", 0.05, 1e-6, 1}}}},
    {kLink, kDelay, "delay", "messages come late, in order", kAnyTime, kNothing, {}, {{{"delay_s", 5e-3, 1e-4, 10}}}},
    {kLink, kJitter, "jitter", "messages come late by up to so much, in order", kAnyTime, kNothing, {},
     {{{"delay_s", 5e-3, 1e-4, 10}}}},
    {kLink, kDuplicate, "duplicate", "messages come twice", kAnyTime, kNothing, {}, {{{"probability", 0.05, 1e-6, 1}}}},
    {kLink, kReorder, "reorder", "a message comes behind the next of its kind", kAnyTime, kStop, {},
     {{{"probability", 0.05, 1e-6, 1}}}},
    {kLink, kCorruptByte, "corrupt_byte", "one bit of a message's frame flips", kAnyTime, kStop, {},
     {{{"probability", 0.05, 1e-6, 1}}}},
    {kLink, kBaudMismatch, "baud_mismatch", "", kAnyTime, kNothing, kNeedsWire, {}},
    {kLink, kBusOff, "bus_off", "", kAnyTime, kNothing, kNeedsWire, {}},
    {kLink, kPeerRestart, "peer_restart", "", kAnyTime, kNothing,
     "in lockstep the two sides share one run; a peer that restarts needs a carrier of its own", {}},
    {kLink, kPeerKilled, "peer_killed", "the plant is gone", kAnyTime, kStop, {}, {}},
    {kLink, kFlood, "flood", "so many measurement messages an exchange more", kAnyTime, kNoTrip, {},
     {{{"messages", 200, 1, 100000}}}},

    {kHost, kLateTick, "late_tick", "the controller is served late once", kAnyTime, kNoTrip, {},
     {{{"delay_s", 2e-3, 1e-3, 0.02}}}},
    {kHost, kMissedTicks, "missed_ticks", "control ticks are missed", kAnyTime, kNothing, {},
     {{{"ticks", 10, 1, 10000}}}},
    {kHost, kClockStep, "clock_step", "", kAnyTime, kNothing,
     "in lockstep the controller has no clock of its own", {}},
    {kHost, kStoppedProcess, "stopped_process", "the controller does not run for a while", kAnyTime, kStop, {},
     {{{"length_s", 0.2, 0.03, 10}}}},
    {kHost, kFullDisk, "full_disk", "", kAnyTime, kNothing,
     "it concerns the record, not the machine: tests/harness/record writes to a full device", {}},
    {kHost, kKilledWhileLogging, "killed_while_logging", "", kAnyTime, kNothing,
     "it ends the bench itself: tests/harness/end_to_end/lost_peer_test.cc kills either process", {}},
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
  constexpr std::array<std::string_view, 8> kNames{
      "end-stop", "kill switch", "encoder", "amplifier", "supply", "drive train", "link", "host"};
  return kNames[static_cast<std::size_t>(part)];
}

}  // namespace towbench::harness
