// Numbers with units, as a person types them: 0.4m/s, 15%, 20cm, 1000counts/s, 300ms.
//
// A bare number means what it meant in BBMC 0.5; which unit that is differs from option to option,
// is part of the option's entry in the command table, and is printed by `help`.
#pragma once

#include <cstdint>
#include <span>
#include <string_view>

#include "core/result.h"

namespace towbench::bbmc {

class TextWriter;

enum class Dimension : std::uint8_t {
  kNone,
  kLength,
  kPosition,  // a length from the axis' origin: a count is the middle of its interval
  kSpeed,
  kAcceleration,
  kTime,
  kFrequency,
  kDuty,              // in per cent of full drive, the unit of every duty in BBMC
  kProportionalGain,  // K_P, K_I, K_D of (4.12), motor angle to motor torque
  kIntegralGain,
  kDerivativeGain,
};

// A gain as BBMC 0.5 took it: % duty per count, per count and sample, per count/s. Its factor to SI
// depends on axis and control rate, so the number stays as typed and its user converts.
inline constexpr std::string_view kBbmcGainUnit = "bbmc";

// SI value = number x multiplier / divisor: both exact, so that 400mm is the same double as 0.4m.
struct Unit {
  std::string_view name;
  Dimension dimension = Dimension::kNone;
  double multiplier = 1;
  double divisor = 1;
  bool is_counts = false;  // encoder counts (or counts/s): the axis' resolution comes on top
};

[[nodiscard]] std::span<const Unit> all_units() noexcept;

// The unit of that dimension with that name; nullptr if there is none.
[[nodiscard]] const Unit* find_unit(Dimension dimension, std::string_view name) noexcept;

// The unit in which help and refusals print that dimension.
[[nodiscard]] const Unit& display_unit(Dimension dimension) noexcept;

// The SI value (per cent for duty) of `text`, a number with or without a unit of `dimension`.
// `bare` is the unit of a number without one. `counts_per_m` belongs to the axis meant; 0 if no
// axis is known, and counts are then refused. kRequestBadArgument for anything else. Gains in
// kBbmcGainUnit come back as they are.
[[nodiscard]] core::Result<double> parse_quantity(std::string_view text, Dimension dimension,
                                                  std::string_view bare,
                                                  double counts_per_m) noexcept;

// value_si in the display unit of its dimension, with that unit behind it.
void write_quantity(TextWriter& writer, double value_si, Dimension dimension) noexcept;

}  // namespace towbench::bbmc
