// What hangs under the X platform into the water: support shaft, test object, and the object's fin.
// SI. By default nothing is in the water, and the machine does not change by one bit.
//
// Shaft and object are separate bodies so that the subtractive approach (3.1) has something to
// subtract: one rig with the shaft alone, one with both.
#pragma once

#include "core/parameter.h"

namespace towbench::emulator {

// One submerged body. Its drag law is body_drag.h's.
struct WaterBodyParameters {
  bool in_water = false;
  double quadratic_drag_N_s2_per_m2 = 0.0;  // D of (8.1), 1/2 rho C_D A of (3.7)
  double linear_drag_N_s_per_m = 0.0;       // B_D of (3.8)
  double across_drag_ratio = 1.0;           // 1: round, drag the same from all sides
  double yaw_deg = 0.0;
  double added_mass_kg = 0.0;  // 1/2 rho V_s of (3.9), the same from all sides

  template <typename Visitor>
  void visit(Visitor& v) {
    v.value("in_water", in_water, core::any_finite(), "whether the water acts on it");
    v.value("quadratic_drag_N_s2_per_m2", quadratic_drag_N_s2_per_m2, core::between(0.0, 1e3),
            "drag over speed squared, towed along the body's axis");
    v.value("linear_drag_N_s_per_m", linear_drag_N_s_per_m, core::between(0.0, 1e3),
            "drag over speed, towed along the body's axis");
    v.value("across_drag_ratio", across_drag_ratio, core::between(0.0, 50.0),
            "both drags across the body's axis over those along it");
    v.value("yaw_deg", yaw_deg, core::between(-360.0, 360.0),
            "body's axis against +Y of the tank, counter-clockwise seen from above");
    v.value("added_mass_kg", added_mass_kg, core::between(0.0, 1e3),
            "water that is accelerated with the body");
  }
};

// Thrust of the object's actuated fin (EXP-5), in the object's frame: forward is its axis, left is
// 90 deg counter-clockwise of it. One stroke pushes left then right and forward twice, so the side
// force swings at half the thrust's frequency.
struct FinParameters {
  bool fitted = false;
  double mean_thrust_N = 0.0;
  double thrust_amplitude_N = 0.0;
  double side_amplitude_N = 0.0;
  double thrust_frequency_Hz = 2.0;  // assumed
  double phase_deg = 0.0;            // of the thrust where the profile begins
  double start_s = 0.0;
  double duration_s = 1e6;

  template <typename Visitor>
  void visit(Visitor& v) {
    v.value("fitted", fitted, core::any_finite(), "whether the object has a working fin");
    v.value("mean_thrust_N", mean_thrust_N, core::between(-1e3, 1e3), "forward, on average");
    v.value("thrust_amplitude_N", thrust_amplitude_N, core::between(0.0, 1e3),
            "of the thrust's oscillation");
    v.value("side_amplitude_N", side_amplitude_N, core::between(0.0, 1e3),
            "of the side force, at half the thrust's frequency");
    v.value("thrust_frequency_Hz", thrust_frequency_Hz, core::between(1e-3, 1e3),
            "of the thrust's oscillation");
    v.value("phase_deg", phase_deg, core::between(-360.0, 360.0),
            "of the thrust's sine at the start of the profile");
    v.value("start_s", start_s, core::between(0.0, 1e6), "when the fin starts");
    v.value("duration_s", duration_s, core::between(0.0, 1e6), "for how long it works");
  }
};

struct WaterParameters {
  WaterBodyParameters shaft;
  WaterBodyParameters object;
  FinParameters fin;

  [[nodiscard]] bool present() const noexcept { return shaft.in_water || object.in_water; }

  template <typename Visitor>
  void visit(Visitor& v) {
    v.group("shaft", shaft, "the support shaft below the platform");
    v.group("object", object, "the test object at the shaft's end");
    v.group("fin", fin, "the object's fin");
  }
};

// What must hold between these and no single range can say, in words that name the key, or null.
[[nodiscard]] const char* inconsistency(const WaterParameters& water) noexcept;

}  // namespace towbench::emulator
