// Every kind of fault there is, as one table: where it may sit, what it means, its parameters, and
// what it takes. Which carriers cannot have it is in carrier_fit.h.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <string_view>

namespace towbench::harness {

enum class FaultPart : std::uint8_t {
  kEndStop,
  kKillSwitch,
  kEncoder,
  kAmplifier,
  kSupply,
  kDriveTrain,
  kLink,
  kHost,
  kHomeSwitch,
};

// Each axis has one of its own.
[[nodiscard]] constexpr bool is_of_an_axis(FaultPart part) noexcept {
  return part == FaultPart::kEndStop || part == FaultPart::kEncoder ||
         part == FaultPart::kAmplifier || part == FaultPart::kDriveTrain ||
         part == FaultPart::kHomeSwitch;
}

enum class FaultKind : std::uint8_t {
  // end-stop; home switch, of these the ones that one switch can have
  kStuckOpen,
  kStuckClosed,
  kBounce,
  kLate,
  kMissing,
  kSwappedEnds,
  kSwappedAxes,
  kDisplaced,
  kLatching,
  kBrokenWire,
  // kill switch (bounce and broken wire as above)
  kPressed,
  kWelded,
  kReleased,
  // encoder
  kDeadA,
  kDeadB,
  kIndexMissing,
  kExtraEdges,
  kMissingEdges,
  kIllegalTransitions,
  kSwappedChannels,
  kInverted,
  kFrozen,
  kJump,
  kSlip,
  kNoiseBurst,
  kPhase,
  // amplifier (inverted as above)
  kDisabled,
  kStuckDuty,
  kSaturatedEarly,
  kGainDrop,
  kOverTemperature,
  kBothChannels,
  // supply
  kOverCurrent,
  kSag,
  // drive train
  kToothSkip,
  kBacklash,
  kJam,
  kDroppedLoad,
  kBrakeDrag,
  kObstacle,
  kBrakeStuck,
  kBrakeLost,
  // link
  kLoss,
  kDelay,
  kJitter,
  kDuplicate,
  kReorder,
  kCorruptByte,
  kBaudMismatch,
  kBusOff,
  kPeerRestart,
  kPeerKilled,
  kFlood,
  // host
  kLateTick,
  kMissedTicks,
  kClockStep,
  kStoppedProcess,
  kFullDisk,
  kKilledWhileLogging,
};

struct FaultParameter {
  std::string_view key;  // with its unit, as in a fixture; empty: there is none
  double standard = 0;
  double min = 0;
  double max = 0;
};

// When a fault may begin.
enum class FaultStart : std::uint8_t {
  kAnyTime,
  kWholeRun,  // as built: no trigger, no duration
};

// What it takes to make it happen.
enum class FaultNeeds : std::uint8_t {
  kNothing,
  kRecord,        // a run folder: it strikes what is written
  kHomeSwitch,    // an axis that has one
  kHoldingBrake,  // likewise
};

// Not every machine can have it: a campaign that is for all of them leaves it out.
[[nodiscard]] constexpr bool needs_a_fitted_part(FaultNeeds needs) noexcept {
  return needs == FaultNeeds::kHomeSwitch || needs == FaultNeeds::kHoldingBrake;
}

// Whether the run may end with it: the two sides do not hear each other any more.
[[nodiscard]] constexpr bool may_end_run(FaultKind kind) noexcept {
  return kind == FaultKind::kPeerKilled || kind == FaultKind::kPeerRestart ||
         kind == FaultKind::kBusOff || kind == FaultKind::kBaudMismatch;
}

// What a controller can be asked to do about it. The judge's rules are in requirements.h.
enum class FaultDuty : std::uint8_t {
  kStop,     // must latch a fault once the fault has shown where the controller can see it
  kNoTrip,   // must go on
  kNothing,  // may do either; the rules for every run hold
};

struct FaultRow {
  FaultPart part = FaultPart::kHost;
  FaultKind kind = FaultKind::kLateTick;
  std::string_view name;
  std::string_view meaning;
  FaultStart start = FaultStart::kAnyTime;
  FaultDuty duty = FaultDuty::kNothing;
  FaultNeeds needs = FaultNeeds::kNothing;
  std::array<FaultParameter, 3> parameters{};
};

[[nodiscard]] std::span<const FaultRow> fault_catalogue() noexcept;
// Null when the part has no kind of that name.
[[nodiscard]] const FaultRow* find_fault(FaultPart part, std::string_view kind) noexcept;
// The row must exist.
[[nodiscard]] const FaultRow& row_of(FaultPart part, FaultKind kind) noexcept;
[[nodiscard]] std::string_view name_of(FaultPart part) noexcept;

}  // namespace towbench::harness
