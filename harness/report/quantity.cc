#include "harness/report/quantity.h"

#include <algorithm>
#include <array>
#include <cmath>

#include <fmt/format.h>

namespace towbench::harness::report {
namespace {

struct Choice {
  std::string_view unit_si;
  double from_si;  // used for magnitudes at or above this
  DisplayUnit shown;
};

// Ordered by unit, then from large to small; the last row of a unit serves everything below.
constexpr std::array kChoices{
    Choice{"m", 10.0, {"m", 1.0}},      Choice{"m", 1e-3, {"mm", 1e3}},
    Choice{"m", 0.0, {"µm", 1e6}},      Choice{"m/s", 10.0, {"m/s", 1.0}},
    Choice{"m/s", 1e-3, {"mm/s", 1e3}}, Choice{"m/s", 0.0, {"µm/s", 1e6}},
    Choice{"rad", 0.1, {"rad", 1.0}},   Choice{"rad", 0.0, {"mrad", 1e3}},
    Choice{"s", 1.0, {"s", 1.0}},       Choice{"s", 1e-3, {"ms", 1e3}},
    Choice{"s", 0.0, {"µs", 1e6}},      Choice{"J", 1.0, {"J", 1.0}},
    Choice{"J", 0.0, {"mJ", 1e3}},      Choice{"V", 0.0, {"V", 1.0}},
};

struct Alias {
  std::string_view written;
  std::string_view unit_si;
};

constexpr std::array kAliases{
    Alias{"m_per_s", "m/s"},     Alias{"pct", "%"},  Alias{"1", ""},
    Alias{"rad_per_s", "rad/s"}, Alias{"Nm", "N m"}, Alias{"m_per_s2", "m/s²"},
    Alias{"m/s2", "m/s²"},
};

std::string_view canonical(std::string_view unit) {
  for (const Alias& alias : kAliases) {
    if (alias.written == unit) {
      return alias.unit_si;
    }
  }
  return unit;
}

}  // namespace

DisplayUnit display_unit(std::string_view unit_si, std::span<const double> values_si) {
  unit_si = canonical(unit_si);
  double largest = 0;
  for (const double value : values_si) {
    largest = std::isfinite(value) ? std::max(largest, std::fabs(value)) : largest;
  }
  DisplayUnit last{unit_si, 1.0};
  for (const Choice& choice : kChoices) {
    if (choice.unit_si == unit_si) {
      last = choice.shown;
      if (largest >= choice.from_si) {
        return last;
      }
    }
  }
  return last;
}

std::string readable_number(double value) {
  if (std::isnan(value)) {
    return "not a number";
  }
  if (std::isinf(value)) {
    return value > 0 ? "∞" : "−∞";
  }
  const double magnitude = std::fabs(value);
  if (magnitude == 0) {
    return "0";
  }
  if (magnitude < 1e-4 || magnitude >= 1e9) {
    return fmt::format("{:.3e}", value);
  }
  const int decimals = std::clamp(3 - static_cast<int>(std::floor(std::log10(magnitude))), 0, 8);
  std::string text = fmt::format("{:.{}f}", magnitude, decimals);
  if (text.find('.') != std::string::npos) {
    text.erase(text.find_last_not_of('0') + 1);
    if (text.back() == '.') {
      text.pop_back();
    }
  }
  return fmt::format("{}{}", value < 0 ? "−" : "", text);
}

std::string readable_quantity(double value_si, std::string_view unit_si) {
  const std::array values{value_si};
  const DisplayUnit unit = display_unit(unit_si, values);
  std::string text = readable_number(value_si * unit.per_si);
  if (!unit.name.empty()) {
    text += "\u00a0";
    text += unit.name;
  }
  return text;
}

}  // namespace towbench::harness::report
