// Parameters of what dry friction may do beyond Coulomb, break-away and Stribeck. All off by
// default.
#pragma once

#include "core/parameter.h"

namespace towbench::emulator {

// Each value is a share of its level: towards max the level is (1 + share), towards min (1 - share)
// of the nominal one.
struct FrictionAsymmetry {
  double coulomb = 0;
  double breakaway = 0;
  double viscous = 0;

  template <typename Visitor>
  void visit(Visitor& v) {
    v.value("coulomb", coulomb, core::between(-0.9, 0.9), "of Coulomb friction, + towards max");
    v.value("breakaway", breakaway, core::between(-0.9, 0.9), "of break-away, + towards max");
    v.value("viscous", viscous, core::between(-0.9, 0.9), "of viscous friction, + towards max");
  }
};

struct FrictionWarming {
  double depth = 0;
  double full_power_W = 1.0;
  double time_constant_s = 300.0;

  template <typename Visitor>
  void visit(Visitor& v) {
    v.value("depth", depth, core::between(0.0, 0.9),
            "share of dry friction that is gone when fully warm; 0: none");
    v.value("full_power_W", full_power_W, core::between(1e-6, 1e6),
            "lasting friction power that warms it fully");
    v.value("time_constant_s", time_constant_s, core::between(1e-3, 1e6), "of warming and cooling");
  }
};

struct Presliding {
  double travel_rad = 0;
  double damping_ratio = 0.5;

  template <typename Visitor>
  void visit(Visitor& v) {
    v.value("travel_rad", travel_rad, core::between(0.0, 1.0),
            "of the motor, from unloaded to break-away; 0: stands still");
    v.value("damping_ratio", damping_ratio, core::between(0.0, 2.0),
            "of each body on its own contact");
  }
};

struct FrictionOptions {
  FrictionAsymmetry asymmetry;
  FrictionWarming warming;
  Presliding presliding;
  double load_ratio = 0;

  // Whether held_terms.h has anything to add; presliding counts where there is friction to bend.
  [[nodiscard]] bool any_held() const noexcept {
    return load_ratio != 0 || warming.depth != 0 || asymmetry.coulomb != 0 ||
           asymmetry.breakaway != 0 || asymmetry.viscous != 0;
  }

  template <typename Visitor>
  void visit(Visitor& v) {
    v.group("asymmetry", asymmetry, "friction that differs by direction");
    v.group("warming", warming, "friction that falls with what it has dissipated");
    v.group("presliding", presliding, "contacts that yield elastically before they slip");
    v.value("load_ratio", load_ratio, core::between(0.0, 0.9),
            "carriage friction a newton of transmission force, added");
  }
};

}  // namespace towbench::emulator
