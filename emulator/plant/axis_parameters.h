// Parameters of one axis: drive, transmission, carriage, hard ends. SI. The defaults are those of
// the tow tank's carriage in docs/reference/constants.md, which names every source.
//
// Inertia and friction are *effective* values seen at the motor shaft, as (3.33) and Table 7.4 have
// them. What belongs to the carriage follows from them (derived_mechanics.h).
#pragma once

#include <array>
#include <string_view>

#include "core/parameter.h"
#include "emulator/plant/disturbance_parameters.h"
#include "emulator/plant/friction_parameters.h"

namespace towbench::emulator {

enum class AmplifierMode { kCurrent, kVoltage };  // CC and VC of 3.3.1

[[nodiscard]] constexpr std::array<std::string_view, 2> names_of(AmplifierMode /*type*/) noexcept {
  return {"current", "voltage"};
}

struct WindingParameters {
  double resistance_ohm = 0.611;         // App. A, line 10
  double inductance_H = 0.119e-3;        // App. A, line 11
  double choke_inductance_H = 0.150e-3;  // of the amplifier, in series

  template <typename Visitor>
  void visit(Visitor& v) {
    v.value("resistance_ohm", resistance_ohm, core::between(1e-3, 1e3), "of winding and brushes");
    v.value("inductance_H", inductance_H, core::between(1e-6, 1.0), "of the winding");
    v.value("choke_inductance_H", choke_inductance_H, core::between(0.0, 1.0),
            "in the amplifier's output, in series");
  }
};

struct AmplifierParameters {
  AmplifierMode mode = AmplifierMode::kCurrent;
  double voltage_gain_V_per_V = 1.08;         // voltage mode: 10 V in, 10.8 V out
  double output_limit_ratio = 0.9;            // of the supply; data sheet, 0.9 Vcc
  double current_loop_bandwidth_Hz = 2500.0;  // data sheet

  template <typename Visitor>
  void visit(Visitor& v) {
    v.value("mode", mode, core::any_finite(), "what the command sets: winding current or voltage");
    v.value("voltage_gain_V_per_V", voltage_gain_V_per_V, core::between(0.0, 1e3),
            "output per command volt, voltage mode only");
    v.value("output_limit_ratio", output_limit_ratio, core::between(0.01, 1.0),
            "largest output voltage over supply voltage");
    v.value("current_loop_bandwidth_Hz", current_loop_bandwidth_Hz, core::between(50.0, 6000.0),
            "of the amplifier's current loop, current mode only");
  }
};

// The gearhead's own faults; off in the nominal rig. Its friction at no load is part of the
// effective friction, as identified.
struct GearParameters {
  double backlash_deg = 0;  // App. A: 0.35
  double efficiency = 1;    // App. A: 0.8

  template <typename Visitor>
  void visit(Visitor& v) {
    v.value("backlash_deg", backlash_deg, core::between(0.0, 10.0), "free play at the output");
    v.value("efficiency", efficiency, core::between(0.3, 1.0),
            "share of the power passing through that arrives");
  }
};

// The transmission between wheel and carriage as one spring and damper (3.36)-(3.38), given by the
// free-free mode that an open-loop motor shows; a carriage against a held motor swings slower.
struct ElasticityParameters {
  bool rigid = false;           // (3.33) instead
  double resonance_Hz = 9.0;    // assumed; seen in Fig. 7.4, never identified
  double damping_ratio = 0.06;  // assumed
  double slack_m = 0;           // off in the nominal rig
  double pretension_N = 0;      // none: no strand ever goes slack

  template <typename Visitor>
  void visit(Visitor& v) {
    v.value("rigid", rigid, core::any_finite(), "motor and carriage move as one");
    v.value("resonance_Hz", resonance_Hz, core::between(0.5, 500.0),
            "undamped natural frequency of motor against carriage, both free");
    v.value("damping_ratio", damping_ratio, core::between(0.0, 1.0), "of that mode");
    v.value("slack_m", slack_m, core::between(0.0, 0.1), "length the carriage can move freely");
    v.value("pretension_N", pretension_N, core::between(0.0, 1e4),
            "of each strand at rest; 0: strands never go slack");
  }
};

// Mechanical stops: a spring and damper beyond each end; they push, never pull.
struct HardEndParameters {
  bool fitted = true;
  double min_m = 0.0;
  double max_m = 3.951997;         // 1,760,000 counts (7.2.1) by (3.42)
  double stiffness_N_per_m = 5e5;  // assumed: 1.8 mm deep from 0.5 m/s
  double damping_N_s_per_m = 1e3;  // assumed

  template <typename Visitor>
  void visit(Visitor& v) {
    v.value("fitted", fitted, core::any_finite(), "whether there are stops at all");
    v.value("min_m", min_m, core::between(-1e4, 1e4), "carriage position at the min stop");
    v.value("max_m", max_m, core::between(-1e4, 1e4), "carriage position at the max stop");
    v.value("stiffness_N_per_m", stiffness_N_per_m, core::between(1e3, 1e7), "of each stop");
    v.value("damping_N_s_per_m", damping_N_s_per_m, core::between(0.0, 1e5), "of each stop");
  }
};

struct AxisParameters {
  double inertia_kg_m2 = 1.714e-5;                  // J, Table 7.4
  double rotor_inertia_kg_m2 = 3.6e-6;              // J_m: rotor, gear, encoder; App. A
  double viscous_friction_Nm_s_per_rad = 1.106e-5;  // B, Table 7.4
  double coulomb_friction_Nm = 2.26e-3;             // C, Table 7.4
  double gear_ratio = 1539.0 / 44.0;                // n, App. A
  double output_radius_m = 0.050;                   // R
  double torque_constant_Nm_per_A = 26.7e-3;        // K_T, Table 7.1
  double amplifier_gain_A_per_V = 0.37;             // K_amp, Table 7.1
  double current_limit_A = 3.7;                     // I_max, Table 7.1
  WindingParameters winding;
  AmplifierParameters amplifier;
  FrictionParameters friction;
  GearParameters gear;
  ElasticityParameters elasticity;
  HardEndParameters hard_ends;
  DisturbanceParameters disturbances;
  // Water that moves with the carriage, (3.9): on top of the inertia, which was identified in air.
  // No key of the axis: the rig sets it from what is in its water.
  double water_mass_kg = 0.0;

  template <typename Visitor>
  void visit(Visitor& v) {
    v.value("inertia_kg_m2", inertia_kg_m2, core::above(0.0),
            "effective inertia at the motor shaft, carriage included");
    v.value("rotor_inertia_kg_m2", rotor_inertia_kg_m2, core::above(0.0),
            "the part of it that turns with the motor; the rest is the carriage");
    v.value("viscous_friction_Nm_s_per_rad", viscous_friction_Nm_s_per_rad, core::at_least(0.0),
            "effective viscous friction at the motor shaft");
    v.value("coulomb_friction_Nm", coulomb_friction_Nm, core::at_least(0.0),
            "effective Coulomb friction at the motor shaft");
    v.value("gear_ratio", gear_ratio, core::above(0.0), "motor turns per output turn");
    v.value("sprocket_radius_m", output_radius_m, core::above(0.0), "pitch radius");
    v.value("torque_constant_Nm_per_A", torque_constant_Nm_per_A, core::above(0.0),
            "also the back-EMF constant in V s/rad");
    v.value("amplifier_gain_A_per_V", amplifier_gain_A_per_V, core::above(0.0),
            "current set-point per command volt, current mode only");
    v.value("current_limit_A", current_limit_A, core::above(0.0), "largest winding current");
    v.group("winding", winding, "motor winding");
    v.group("amplifier", amplifier, "servo amplifier");
    v.group("friction", friction, "dry friction");
    v.group("gear", gear, "gearhead");
    v.group("elasticity", elasticity, "of the transmission between motor and carriage");
    v.group("hard_ends", hard_ends, "mechanical stops");
    v.group("disturbances", disturbances, "what else pushes");
  }
};

// What must hold between parameters and no single range can say: the sentence names the key. Null
// when all is well.
[[nodiscard]] const char* inconsistency(const AxisParameters& parameters) noexcept;

}  // namespace towbench::emulator
