#include "study/results/foreign_machines.h"

#include <algorithm>
#include <array>

namespace towbench::study {
namespace {

using emulator::AxisParameters;

constexpr std::array<ForeignStructure, 15> kStructures{{
    {"own", "the two-mass model with Gaussian Stribeck friction itself", "to compare with",
     [](AxisParameters& /*axis*/) {}},
    {"lorentz", "Stribeck friction that falls by the Lorentz form", "(3.26)",
     [](AxisParameters& a) { a.friction.stribeck_form = emulator::StribeckForm::kLorentz; }},
    {"asymmetry", "Coulomb friction 16 % higher towards max than its mean, 16 % lower towards min",
     "EMPS: offset 3.2 N of 20.4 N (Janot et al. 2019)",
     [](AxisParameters& a) {
       a.friction.options.asymmetry.coulomb = 0.16;
       a.friction.options.asymmetry.breakaway = 0.16;
     }},
    {"presliding", "contacts that yield by 0.05 rad of the motor, 70 um of the Y carriage",
     "tens of um in geared drives; *assumed*",
     [](AxisParameters& a) { a.friction.options.presliding.travel_rad = 0.05; }},
    {"load_friction", "carriage friction that grows by 8 % of the transmission's force",
     "the least of `docs/reference/hidden-effects.md`",
     [](AxisParameters& a) { a.friction.options.load_ratio = 0.08; }},
    {"gear_loss", "a gear that passes on 80 % of the power", "App. A, gearhead",
     [](AxisParameters& a) { a.gear.efficiency = 0.8; }},
    {"play", "gear play of 0.35 degrees at the output", "App. A, gearhead",
     [](AxisParameters& a) { a.gear.backlash_deg = 0.35; }},
    {"torque_ripple", "torque ripple of 15 % of C, once a motor turn",
     "the least of `docs/reference/hidden-effects.md`",
     [](AxisParameters& a) {
       a.disturbances.torque_ripple.amplitude_Nm = 0.15 * a.coulomb_friction_Nm;
       a.disturbances.torque_ripple.periods_per_turn = 1;
     }},
    {"eccentric_wheel", "a wheel 0.08 mm out of centre",
     "ISO 606: radial run-out 0.0008 d + 0.08 mm",
     [](AxisParameters& a) { a.disturbances.wheel.eccentricity_m = 0.08e-3; }},
    {"polygon", "a wheel of few teeth: links lie on it as a polygon of 12.7 mm a side",
     "ISO 606, 08B: 25 teeth on Y, 15 on X",
     [](AxisParameters& a) { a.disturbances.wheel.teeth = a.output_radius_m > 0.04 ? 25 : 15; }},
    {"pretension", "transmission strands that go slack at 5 N: half the stiffness beyond",
     "*assumed*, below the pulses' force",
     [](AxisParameters& a) { a.elasticity.pretension_N = 5; }},
    {"rigid", "motor and carriage move as one", "(3.33)",
     [](AxisParameters& a) { a.elasticity.rigid = true; }},
    {"slow_amplifier", "a current loop of 100 Hz, documented as 2.5 kHz",
     "*assumed*: a lag of 1.6 ms; 3 to 6 ms in `docs/reference/hidden-effects.md`",
     [](AxisParameters& a) { a.amplifier.current_loop_bandwidth_Hz = 100; }},
    {"tilt", "rails 0.2 degrees out of level", "*assumed*: 3.5 mm a metre",
     [](AxisParameters& a) { a.disturbances.tilt_deg = 0.2; }},
    {"cable", "cables that pull the carriage back by 0.5 N a metre",
     "the least of `docs/reference/hidden-effects.md`: 25 % of C a metre",
     [](AxisParameters& a) {
       a.disturbances.cable.stiffness_N_per_m = 0.5;
       a.disturbances.cable.reference_m = 0.5 * (a.hard_ends.min_m + a.hard_ends.max_m);
     }},
}};

}  // namespace

std::span<const ForeignStructure> foreign_structures() noexcept {
  return kStructures;
}

const ForeignStructure* find_structure(std::string_view name) noexcept {
  const auto* found = std::find_if(kStructures.begin(), kStructures.end(),
                                   [&](const auto& each) { return each.name == name; });
  return found == kStructures.end() ? nullptr : found;
}

emulator::RigParameters built(emulator::RigParameters rig, const ForeignStructure& structure) {
  for (const auto axis : core::kPlanarAxes) {
    structure.build(rig.axes[axis].plant);
  }
  return rig;
}

}  // namespace towbench::study
