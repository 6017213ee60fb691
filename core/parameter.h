// How a plain parameter struct describes itself, once, to the file reader, the command line, the
// documentation and whoever writes it back.
//
//   struct Gearbox {
//     double ratio = 34.977;
//     template <typename Visitor>
//     void visit(Visitor& v) {
//       v.value("gear_ratio", ratio, at_least(1.0), "motor turns per output turn");
//     }
//   };
//
// A visitor offers value(key, field, range, meaning) for double, bool, std::int64_t and enums with
// names, list(key, field, range, meaning) for a core::BoundedVector<double, N> (a TOML array), and
// group(key, nested, meaning) for a nested struct. What a machine may do without, a struct with
// `bool fitted`, goes through visit_if_fitted(): it has no key while it is not fitted, and a
// reader's optional_group(key, nested, meaning) fits it where it finds its table. The unit is the
// key's suffix. An enum E with names has, beside it, `constexpr std::array<std::string_view, n>
// names_of(E)`: one name a value, in order.
#pragma once

namespace towbench::core {

// No quantity of a machine is larger; what is, was mistyped.
inline constexpr double kLargestQuantity = 1e12;

struct Range {
  double min = -kLargestQuantity;
  double max = kLargestQuantity;
  bool min_is_allowed = true;

  // NaN and infinities are inside no range.
  [[nodiscard]] constexpr bool contains(double value) const noexcept {
    return (min_is_allowed ? value >= min : value > min) && value <= max;
  }
};

template <typename Visitor, typename Nested>
void visit_if_fitted(Visitor& v, const char* key, Nested& nested, const char* meaning) {
  if constexpr (requires { v.optional_group(key, nested, meaning); }) {
    v.optional_group(key, nested, meaning);
  } else if (nested.fitted) {
    v.group(key, nested, meaning);
  }
}

[[nodiscard]] constexpr Range any_finite() noexcept {
  return {};
}
[[nodiscard]] constexpr Range at_least(double min) noexcept {
  return {.min = min};
}
[[nodiscard]] constexpr Range above(double min) noexcept {
  return {.min = min, .min_is_allowed = false};
}
[[nodiscard]] constexpr Range between(double min, double max) noexcept {
  return {.min = min, .max = max};
}

}  // namespace towbench::core
