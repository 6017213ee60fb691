#include "bbmc/application/console/quantity.h"

#include <array>
#include <optional>

#include "bbmc/application/console/decimal.h"
#include "bbmc/application/console/text_writer.h"

namespace towbench::bbmc {
namespace {

// The first unit of each dimension is the one that is printed.
constexpr std::array kUnits{
    Unit{.name = "", .dimension = Dimension::kNone},
    Unit{.name = "m", .dimension = Dimension::kLength},
    Unit{.name = "cm", .dimension = Dimension::kLength, .divisor = 100},
    Unit{.name = "mm", .dimension = Dimension::kLength, .divisor = 1e3},
    Unit{.name = "um", .dimension = Dimension::kLength, .divisor = 1e6},
    Unit{.name = "counts", .dimension = Dimension::kLength, .is_counts = true},
    Unit{.name = "m", .dimension = Dimension::kPosition},
    Unit{.name = "cm", .dimension = Dimension::kPosition, .divisor = 100},
    Unit{.name = "mm", .dimension = Dimension::kPosition, .divisor = 1e3},
    Unit{.name = "um", .dimension = Dimension::kPosition, .divisor = 1e6},
    Unit{.name = "counts", .dimension = Dimension::kPosition, .is_counts = true},
    Unit{.name = "m/s", .dimension = Dimension::kSpeed},
    Unit{.name = "cm/s", .dimension = Dimension::kSpeed, .divisor = 100},
    Unit{.name = "mm/s", .dimension = Dimension::kSpeed, .divisor = 1e3},
    Unit{.name = "counts/s", .dimension = Dimension::kSpeed, .is_counts = true},
    Unit{.name = "m/s2", .dimension = Dimension::kAcceleration},
    Unit{.name = "mm/s2", .dimension = Dimension::kAcceleration, .divisor = 1e3},
    Unit{.name = "s", .dimension = Dimension::kTime},
    Unit{.name = "ms", .dimension = Dimension::kTime, .divisor = 1e3},
    Unit{.name = "Hz", .dimension = Dimension::kFrequency},
    Unit{.name = "mHz", .dimension = Dimension::kFrequency, .divisor = 1e3},
    Unit{.name = "kHz", .dimension = Dimension::kFrequency, .multiplier = 1e3},
    Unit{.name = "%", .dimension = Dimension::kDuty},
    Unit{.name = "Nm/rad", .dimension = Dimension::kProportionalGain},
    Unit{.name = kBbmcGainUnit, .dimension = Dimension::kProportionalGain},
    Unit{.name = "Nm/(rad*s)", .dimension = Dimension::kIntegralGain},
    Unit{.name = kBbmcGainUnit, .dimension = Dimension::kIntegralGain},
    Unit{.name = "Nm*s/rad", .dimension = Dimension::kDerivativeGain},
    Unit{.name = kBbmcGainUnit, .dimension = Dimension::kDerivativeGain},
};

constexpr int kPrintedDecimals = 9;

}  // namespace

std::span<const Unit> all_units() noexcept {
  return kUnits;
}

const Unit* find_unit(Dimension dimension, std::string_view name) noexcept {
  for (const Unit& unit : kUnits) {
    if (unit.dimension == dimension && unit.name == name) {
      return &unit;
    }
  }
  return nullptr;
}

const Unit& display_unit(Dimension dimension) noexcept {
  for (const Unit& unit : kUnits) {
    if (unit.dimension == dimension) {
      return unit;
    }
  }
  return kUnits.front();
}

core::Result<double> parse_quantity(std::string_view text, Dimension dimension,
                                    std::string_view bare, double counts_per_m) noexcept {
  const std::optional<Decimal> number = parse_decimal(text);
  if (!number) {
    return core::failure(core::ErrorCode::kRequestBadArgument);
  }
  const Unit* const unit = find_unit(dimension, number->rest.empty() ? bare : number->rest);
  if (unit == nullptr || (unit->is_counts && counts_per_m <= 0)) {
    return core::failure(core::ErrorCode::kRequestBadArgument);
  }
  if (!unit->is_counts) {
    return number->value * unit->multiplier / unit->divisor;
  }
  const double middle = dimension == Dimension::kPosition ? 0.5 : 0.0;
  return (number->value + middle) / counts_per_m;
}

void write_quantity(TextWriter& writer, double value_si, Dimension dimension) noexcept {
  writer.compact(value_si, kPrintedDecimals).text(display_unit(dimension).name);
}

}  // namespace towbench::bbmc
