// Presliding: a body at rest hangs on an elastic contact and comes back when let go. The contact is
// Prandtl's element, a spring that slides once it is bent by its travel:
//
//   friction = -grip,  grip = level (q - q_0) / travel + sigma_1 q',  while |q - q_0| < travel
//   sigma_1  = 2 zeta sqrt(sigma_0 m),  sigma_0 = S / travel
//
// `level` is what break-away takes under the present load, place and warmth, on the side to which
// the contact is bent. So the stiffness goes with the load, as of contacts of rough bodies, and no
// change of load tears the body off or lets it creep. A body that stops has slid with its contact
// fully bent: q_0 is laid travel behind it, and friction does not jump. A load below break-away
// bends the contact by travel * load / level and never moves q_0: no drift, which LuGre has
// (Dupont, Hayward, Armstrong, Altpeter 2002, on elasto-plastic friction).
#pragma once

#include <cmath>

#include "emulator/plant/derived_mechanics.h"

namespace towbench::emulator {

struct ElasticContact {
  double travel = 0;     // rad or m, from relaxed to sliding; 0: the body stands still
  double breakaway = 0;  // nominal level: that of the linear mode
  double stiffness = 0;  // sigma_0
  double damping = 0;    // sigma_1

  [[nodiscard]] bool present() const noexcept { return stiffness > 0; }
};

// `travel` in the body's own coordinate.
[[nodiscard]] inline ElasticContact elastic_contact(const DryFriction& law, double travel,
                                                    double damping_ratio, double inertia) noexcept {
  if (travel <= 0 || !law.present()) {
    return {};
  }
  const double stiffness = law.breakaway / travel;
  return {.travel = travel,
          .breakaway = law.breakaway,
          .stiffness = stiffness,
          .damping = 2.0 * damping_ratio * std::sqrt(stiffness * inertia)};
}

// Where a contact is relaxed when its body stops at `position` after sliding in `direction`. A
// billionth short of its travel, so that rounding cannot tear it off again.
[[nodiscard]] inline double anchor_after_sliding(const ElasticContact& contact, double position,
                                                 double direction) noexcept {
  constexpr double kJustInside = 1.0 - 1e-9;
  return position - direction * kJustInside * contact.travel;
}

}  // namespace towbench::emulator
