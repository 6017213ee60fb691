// The discrete state of an axis: between two changes of it the axis is one linear mode.
#pragma once

#include <cstddef>
#include <cstdint>

namespace towbench::emulator {

// What the amplifier does with the winding.
enum class Drive : std::uint8_t {
  kRegulated,       // current loop in control
  kLimited,         // current loop at the output voltage limit
  kVoltage,         // voltage mode
  kCurrentLimited,  // voltage mode at the current limit
  kFreewheel,       // disabled, current flows back into the supply through the diodes
  kOpen,            // disabled, no current
};

enum class HardEnd : std::uint8_t {
  kClear,
  kPushing,     // the stop pushes on the carriage
  kRebounding,  // the carriage leaves faster than the stop follows
};

// Between motor and carriage (transmission_play.h). Without play or strands always taut.
enum class TransmissionContact : std::uint8_t {
  kTaut,       // the transmission pulls
  kOneStrand,  // by one strand only
  kOpen,       // inside the gap
  kLeaving,    // past it, but the force would pull apart
};

struct Regime {
  Drive drive = Drive::kOpen;
  HardEnd end = HardEnd::kClear;
  TransmissionContact transmission = TransmissionContact::kTaut;
  double drive_sign = 1;          // of limit or current: +1, -1
  double end_sign = 1;            // +1 max stop, -1 min stop
  double transmission_sign = 0;   // side of the gap; 0: there is none
  double motor_direction = 0;     // +1, -1; 0: sticks
  double carriage_direction = 0;  // likewise; unused with a rigid transmission
};

// Linear modes differ in these only.
enum class Winding : std::uint8_t { kCurrentLoop, kLimitedLoop, kFixedVoltage, kFixedCurrent };
enum class TransmissionPull : std::uint8_t { kBothStrands, kOneStrand, kNone };
inline constexpr std::size_t kModesPerPull = 4 * 2 * 2 * 2;
inline constexpr std::size_t kModeCount = 3 * kModesPerPull;

struct ModeKey {
  Winding winding = Winding::kFixedCurrent;
  bool motor_moves = false;
  bool carriage_moves = false;
  bool end_pushes = false;
  TransmissionPull pull = TransmissionPull::kBothStrands;

  // 0 .. kModeCount - 1, and back.
  [[nodiscard]] constexpr std::size_t index() const noexcept {
    return (((static_cast<std::size_t>(pull) * 4 + static_cast<std::size_t>(winding)) * 2 +
             (motor_moves ? 1U : 0U)) *
                2 +
            (carriage_moves ? 1U : 0U)) *
               2 +
           (end_pushes ? 1U : 0U);
  }
  [[nodiscard]] static constexpr ModeKey of_index(std::size_t index) noexcept {
    return {.winding = static_cast<Winding>(index % kModesPerPull / 8),
            .motor_moves = (index & 4U) != 0,
            .carriage_moves = (index & 2U) != 0,
            .end_pushes = (index & 1U) != 0,
            .pull = static_cast<TransmissionPull>(index / kModesPerPull)};
  }
};

[[nodiscard]] constexpr Winding winding_of(Drive drive) noexcept {
  switch (drive) {
    case Drive::kRegulated:
      return Winding::kCurrentLoop;
    case Drive::kLimited:
      return Winding::kLimitedLoop;
    case Drive::kVoltage:
    case Drive::kFreewheel:
      return Winding::kFixedVoltage;
    case Drive::kCurrentLimited:
    case Drive::kOpen:
      break;
  }
  return Winding::kFixedCurrent;
}

[[nodiscard]] constexpr TransmissionPull pull_of(TransmissionContact contact) noexcept {
  switch (contact) {
    case TransmissionContact::kTaut:
      return TransmissionPull::kBothStrands;
    case TransmissionContact::kOneStrand:
      return TransmissionPull::kOneStrand;
    case TransmissionContact::kOpen:
    case TransmissionContact::kLeaving:
      break;
  }
  return TransmissionPull::kNone;
}

[[nodiscard]] constexpr ModeKey mode_of(const Regime& regime) noexcept {
  return {.winding = winding_of(regime.drive),
          .motor_moves = regime.motor_direction != 0,
          .carriage_moves = regime.carriage_direction != 0,
          .end_pushes = regime.end == HardEnd::kPushing,
          .pull = pull_of(regime.transmission)};
}

}  // namespace towbench::emulator
