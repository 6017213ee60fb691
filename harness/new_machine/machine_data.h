// What the owner of a one-axis machine has at hand: data sheets, a rule and a scale. SI.
#pragma once

#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "core/parameter.h"

namespace towbench::harness {

// A number that is asked for, by the name of its option.
struct MachineNumber {
  std::string_view option;  // with its unit
  core::Range range;
  std::string_view meaning;
  std::optional<double> otherwise{};  // taken where none is given; without it the number is needed
  std::string_view of_kinds{};        // blank: of all; else the kinds of transmission that have it
};

enum class Number : std::size_t {
  kLead,
  kRadius,
  kGearRatio,
  kMass,
  kRotorInertia,
  kTorqueConstant,
  kResistance,
  kAmplifierGain,
  kCurrentLimit,
  kSupply,
  kEncoderLines,
  kStroke,
  kFriction,
  kBandwidth,
  kCount
};

struct MachineData {
  std::string name = "mine";
  std::string kind;      // of transmission: chain, belt, screw, rack
  std::string switches;  // at the ends: both, min, max, none
  std::vector<std::optional<double>> numbers =
      std::vector<std::optional<double>>(static_cast<std::size_t>(Number::kCount));

  // What was given, or what is taken otherwise.
  [[nodiscard]] double operator[](Number which) const;
};

// One a Number, in order.
[[nodiscard]] std::span<const MachineNumber> machine_numbers() noexcept;
[[nodiscard]] bool has_number(std::string_view kind, const MachineNumber& number) noexcept;

// What contradicts itself though each number is in its range: a sentence that names the option, or
// blank.
[[nodiscard]] std::string inconsistency(const MachineData& data);

}  // namespace towbench::harness
