// How a command describes itself, once: the parser, its refusals, `help` and the README all read
// this table, so they cannot drift apart.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <string_view>

#include "bbmc/application/console/quantity.h"
#include "core/axis.h"
#include "core/check.h"
#include "core/error.h"
#include "core/parameter.h"

namespace towbench::bbmc {

enum class OptionKind : std::uint8_t {
  kFlag,      // given or not
  kQuantity,  // a number with a unit
  kWhole,     // a whole number
  kChoice,    // one of names, separated by |
  kAxis,      // y or 1, x or 2
};

enum class Presence : std::uint8_t {
  kRequired,
  kDefault,   // default_value holds when it is not given
  kOptional,  // left alone when it is not given
};

// Which axis' resolution turns counts into metres.
enum class CountsOf : std::uint8_t { kNoAxis, kDof, kY, kX };

// -traject asks for the first kind when it is not given, -contrl for the second.
enum class AskedBy : std::uint8_t { kNobody, kTraject, kContrl };

struct OptionSpec {
  std::string_view name{};        // "--speed"; without dashes a positional argument
  std::string_view short_name{};  // of BBMC 0.5, if it had one
  OptionKind kind = OptionKind::kQuantity;
  Presence presence = Presence::kDefault;
  Dimension dimension = Dimension::kNone;
  std::string_view bare_unit{};  // what a bare number means
  core::Range range{};           // SI, % for duty
  double default_value = 0;      // SI; the index of a choice; the index of an axis
  std::string_view
      default_text{};  // instead, where the SI value depends on the axis: "1000counts/s"
  std::string_view choices{};
  CountsOf counts_of = CountsOf::kNoAxis;
  AskedBy asked_by = AskedBy::kNobody;
  // With its short name it takes two values, the second for the option that follows in the table.
  bool short_name_takes_two = false;
  std::string_view meaning{};

  [[nodiscard]] constexpr bool is_positional() const noexcept { return !name.starts_with('-'); }
};

inline constexpr std::size_t kMaxOptions = 20;

// The values of a command's options, by their place in its table.
class Arguments {
 public:
  [[nodiscard]] bool given(std::size_t option) const noexcept { return at(option).given; }
  [[nodiscard]] double number(std::size_t option) const noexcept { return at(option).number; }
  [[nodiscard]] std::size_t choice(std::size_t option) const noexcept {
    return static_cast<std::size_t>(at(option).number);
  }
  [[nodiscard]] core::Axis axis(std::size_t option) const noexcept {
    return choice(option) == 0 ? core::Axis::kY : core::Axis::kX;
  }
  // Whether the number came in a unit of BBMC 0.5 that has no fixed factor to SI (gains).
  [[nodiscard]] bool in_bbmc_units(std::size_t option) const noexcept {
    return at(option).in_bbmc_units;
  }

  void set(std::size_t option, double number, bool in_bbmc_units = false) noexcept {
    core::check(option < kMaxOptions);
    values_[option] = {.number = number, .given = true, .in_bbmc_units = in_bbmc_units};
  }
  void set_default(std::size_t option, double number) noexcept {
    core::check(option < kMaxOptions);
    values_[option] = {.number = number};
  }

 private:
  struct Value {
    double number = 0;
    bool given = false;
    bool in_bbmc_units = false;
  };
  [[nodiscard]] const Value& at(std::size_t option) const noexcept {
    core::check(option < kMaxOptions);
    return values_[option];
  }

  std::array<Value, kMaxOptions> values_{};
};

struct CommandContext;

// kNone, or why it was refused; then nothing has changed.
using CommandHandler = core::ErrorCode (*)(CommandContext&, const Arguments&);

struct CommandSpec {
  std::string_view word{};  // "run"
  std::string_view sub{};   // "-trapez"; may be empty
  bool is_default = false;  // also meant when no sub-command is named
  std::span<const OptionSpec> options{};
  CommandHandler handler = nullptr;
  std::string_view meaning{};
};

}  // namespace towbench::bbmc
