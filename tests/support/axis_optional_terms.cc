#include "tests/support/axis_optional_terms.h"

#include <array>

namespace towbench::tests {
namespace {

using emulator::AxisParameters;

void bend_the_rails(AxisParameters& p) {
  p.disturbances.cable = {.stiffness_N_per_m = 1.5, .reference_m = 1.5};
  p.disturbances.tilt_deg = 0.2;
  auto& force = p.disturbances.position_force;
  force.position_m.assign(std::array{1.9, 2.0, 2.1});
  force.torque_Nm.assign(std::array{0.0, 4e-4, -2e-4});
}

}  // namespace

std::vector<OptionalTerm> optional_terms() {
  return {
      {"torque ripple",
       [](AxisParameters& p) {
         p.disturbances.torque_ripple = {
             .amplitude_Nm = 3e-4, .periods_per_turn = 7, .phase_deg = 30};
       }},
      {"eccentric wheel",
       [](AxisParameters& p) {
         p.disturbances.wheel.eccentricity_m = 2e-4;
         p.disturbances.wheel.eccentricity_phase_deg = 40;
       }},
      {"polygon", [](AxisParameters& p) { p.disturbances.wheel.teeth = 13; }},
      {"cable, tilt, position force", bend_the_rails},
      {"weight of a joint",
       [](AxisParameters& p) { p.disturbances.gravity = {.torque_Nm = 1.5, .zero_at_deg = 40}; }},
      {"asymmetry",
       [](AxisParameters& p) {
         p.friction.options.asymmetry = {.coulomb = 0.2, .breakaway = 0.15, .viscous = 0.3};
       }},
      {"load", [](AxisParameters& p) { p.friction.options.load_ratio = 0.1; }},
      {"gear efficiency", [](AxisParameters& p) { p.gear.efficiency = 0.8; }},
      {"warming",
       [](AxisParameters& p) {
         p.friction.options.warming = {.depth = 0.3, .full_power_W = 0.05, .time_constant_s = 2.0};
       }},
      {"presliding",
       [](AxisParameters& p) {
         p.friction.options.presliding = {.travel_rad = 0.02, .damping_ratio = 0.5};
       }},
      {"backlash", [](AxisParameters& p) { p.gear.backlash_deg = 0.35; }},
      {"pre-tension", [](AxisParameters& p) { p.elasticity.pretension_N = 3.0; }},
      {"slack", [](AxisParameters& p) { p.elasticity.slack_m = 1e-3; }},
  };
}

AxisParameters with_every_term(AxisParameters axis) {
  for (const OptionalTerm& term : optional_terms()) {
    if (term.name != "slack") {
      term.add_to(axis);
    }
  }
  return axis;
}

}  // namespace towbench::tests
