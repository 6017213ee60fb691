// Parameters of what pushes an axis besides motor and friction: torque ripple, an eccentric or
// many-sided wheel, cables, a tilted rail, a joint's weight, a force that depends on place. All
// off by default.
#pragma once

#include "core/bounded_vector.h"
#include "core/parameter.h"

namespace towbench::emulator {

struct TorqueRippleParameters {
  double amplitude_Nm = 0;
  double periods_per_turn = 1;
  double phase_deg = 0;

  template <typename Visitor>
  void visit(Visitor& v) {
    v.value("amplitude_Nm", amplitude_Nm, core::at_least(0.0), "of the torque; 0: none");
    v.value("periods_per_turn", periods_per_turn, core::between(0.01, 200.0),
            "of the motor: poles, slots or a harmonic of them");
    v.value("phase_deg", phase_deg, core::between(-360.0, 360.0), "at motor angle 0");
  }
};

struct WheelParameters {
  double eccentricity_m = 0;
  double eccentricity_phase_deg = 0;
  double teeth = 0;

  template <typename Visitor>
  void visit(Visitor& v) {
    v.value("eccentricity_m", eccentricity_m, core::between(0.0, 0.01),
            "of the wheel's centre; 0: runs true");
    v.value("eccentricity_phase_deg", eccentricity_phase_deg, core::between(-360.0, 360.0),
            "at motor angle 0");
    v.value("teeth", teeth, core::between(0.0, 200.0),
            "on which links lie as a polygon, from 5; 0: a circle");
  }
};

struct CableParameters {
  double stiffness_N_per_m = 0;
  double reference_m = 0;

  template <typename Visitor>
  void visit(Visitor& v) {
    v.value("stiffness_N_per_m", stiffness_N_per_m, core::between(0.0, 1e4),
            "with which cables pull the carriage back; 0: none");
    v.value("reference_m", reference_m, core::between(-1e4, 1e4), "where they do not pull");
  }
};

// tau_P(x) outside the sign function, as (4.2) prints it: a force that does not reverse with the
// motion. Piecewise linear, constant beyond the first and the last knot; no knots: none.
struct PositionForce {
  using Table = core::BoundedVector<double, 32>;
  Table position_m;  // strictly ascending, carriage
  Table torque_Nm;   // at the motor, one a position, + towards max

  template <typename Visitor>
  void visit(Visitor& v) {
    v.list("position_m", position_m, core::between(-1e4, 1e4), "carriage positions, ascending");
    v.list("torque_Nm", torque_Nm, core::any_finite(),
           "force at each position as a torque at the motor, + towards max");
  }
};

// The weight of a load that turns: F = -m g l sin(q + q0) with q in rad, q0 the angle at which q =
// 0 stands from hanging. The law of the physical pendulum; m, l: mass and distance of its centre
// from the axis of rotation.
struct GravityParameters {
  double torque_Nm = 0;
  double zero_at_deg = 0;

  template <typename Visitor>
  void visit(Visitor& v) {
    v.value("torque_Nm", torque_Nm, core::between(0.0, 1e6),
            "m g l of a load that turns, the most that its weight takes; 0: none");
    v.value("zero_at_deg", zero_at_deg, core::between(-360.0, 360.0),
            "from hanging to position 0, + towards max");
  }
};

struct DisturbanceParameters {
  TorqueRippleParameters torque_ripple;
  WheelParameters wheel;
  CableParameters cable;
  PositionForce position_force;
  GravityParameters gravity;
  double tilt_deg = 0;

  // Whether held_terms.h has anything to add: cable and tilt are part of the linear mode.
  [[nodiscard]] bool any_held() const noexcept {
    return torque_ripple.amplitude_Nm != 0 || wheel.eccentricity_m != 0 || wheel.teeth != 0 ||
           !position_force.position_m.empty() || gravity.torque_Nm != 0;
  }

  template <typename Visitor>
  void visit(Visitor& v) {
    v.group("torque_ripple", torque_ripple, "torque that depends on the motor's angle");
    v.group("wheel", wheel, "a wheel that is not a true circle");
    v.group("cable", cable, "cables that pull on the carriage");
    v.group("position_force", position_force, "a force that depends on where the carriage is");
    v.group("gravity", gravity, "the weight of a load that turns");
    v.value("tilt_deg", tilt_deg, core::between(-90.0, 90.0),
            "of the rails; + when the max end is the higher one, 90: upright");
  }
};

}  // namespace towbench::emulator
