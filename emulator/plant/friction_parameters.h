// Parameters of dry friction, motor side. Values and sources: docs/reference/constants.md.
//
// The effective values of an axis are split between the motor (with gear and wheels) and the
// carriage by `carriage_share`; on the carriage a torque becomes a force by n/R.
#pragma once

#include <array>
#include <string_view>

#include "core/bounded_vector.h"
#include "core/parameter.h"
#include "emulator/plant/friction_option_parameters.h"

namespace towbench::emulator {

// How friction falls from break-away to Coulomb level with speed.
enum class StribeckForm { kGaussian, kLorentz };  // (3.25), (3.26)

[[nodiscard]] constexpr std::array<std::string_view, 2> names_of(StribeckForm /*type*/) noexcept {
  return {"gaussian", "lorentz"};
}

// Friction added where the rollers run hard: tau_P(x) of (3.34), inside the sign function, so it
// always brakes. Piecewise linear between knots, constant beyond the first and the last; no knots:
// none. Acts on the carriage.
struct PositionFriction {
  using Table = core::BoundedVector<double, 32>;
  Table position_m;   // strictly ascending, carriage
  Table friction_Nm;  // at the motor, one a position

  template <typename Visitor>
  void visit(Visitor& v) {
    v.list("position_m", position_m, core::any_finite(), "carriage positions, ascending");
    v.list("friction_Nm", friction_Nm, core::at_least(0.0),
           "added friction at each position, at the motor");
  }
};

struct FrictionParameters {
  double breakaway_Nm = 3.7e-3;           // (7.2), mean; S >= C
  double stribeck_speed_rad_per_s = 6.0;  // assumed
  StribeckForm stribeck_form = StribeckForm::kGaussian;
  double carriage_share = 0.65;  // assumed; of Coulomb, break-away and viscous friction
  PositionFriction position;
  FrictionOptions options;

  template <typename Visitor>
  void visit(Visitor& v) {
    v.value("breakaway_Nm", breakaway_Nm, core::at_least(0.0),
            "torque at the motor below which the axis sticks; not below Coulomb friction");
    v.value("stribeck_speed_rad_per_s", stribeck_speed_rad_per_s, core::between(1e-3, 1e3),
            "motor speed scale of the fall from break-away to Coulomb friction");
    v.value("stribeck_form", stribeck_form, core::any_finite(), "shape of that fall");
    v.value("carriage_share", carriage_share, core::between(0.0, 1.0),
            "share of Coulomb, break-away and viscous friction that acts on the carriage");
    v.group("position", position, "friction that depends on where the carriage is");
    options.visit(v);
  }
};

}  // namespace towbench::emulator
