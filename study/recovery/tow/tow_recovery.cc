#include "study/recovery/tow/tow_recovery.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "emulator/water/water.h"
#include "study/recovery/tow/blind_model_bias.h"

namespace towbench::study {
namespace {

using emulator::RigParameters;
using emulator::WaterBodyParameters;
using identify::Estimate;

double all_drag(const RigParameters& rig) {
  const auto of = [](const WaterBodyParameters& body) {
    return body.in_water ? body.quadratic_drag_N_s2_per_m2 : 0.0;
  };
  return of(rig.water.shaft) + of(rig.water.object);
}

double object_drag(const RigParameters& rig) {
  return rig.water.object.quadratic_drag_N_s2_per_m2;
}

// Along the motion, of a long body at a yaw angle (docs/theory/plant.md, 8).
double drag_at_yaw(const RigParameters& rig, const Estimate& estimate) {
  const double yaw = estimate.at.value_or(0) * std::numbers::pi / 180.0;
  const double across = rig.water.object.across_drag_ratio;
  return object_drag(rig) * (std::pow(std::cos(yaw), 2) + across * std::pow(std::sin(yaw), 2));
}

double force_per_duty(const RigParameters& rig) {
  const auto& axis = rig.axes[core::Axis::kY];
  return axis.plant.gear_ratio / axis.plant.output_radius_m * axis.plant.torque_constant_Nm_per_A *
         axis.plant.amplifier_gain_A_per_V * axis.command.pwm_amplitude_V / 100.0;
}

struct Demand {
  std::string_view quantity;
  double tolerance_pct;  // 0: none, its interval alone is judged
  double (*truth)(const RigParameters&, const Estimate&);
};

// TOW-1 to TOW-9 of docs/requirements.md.
constexpr auto kAllDrag = [](const RigParameters& rig, const Estimate&) { return all_drag(rig); };
constexpr auto kObjectDrag = [](const RigParameters& rig, const Estimate&) {
  return object_drag(rig);
};
constexpr auto kAddedMass = [](const RigParameters& rig, const Estimate&) {
  return emulator::added_mass_kg(rig.water);
};
constexpr auto kDragAtSpeed = [](const RigParameters& rig, const Estimate& estimate) {
  return all_drag(rig) * std::pow(estimate.at.value_or(0), 2);
};
constexpr auto kThrust = [](const RigParameters& rig, const Estimate&) {
  return rig.water.fin.mean_thrust_N;
};

const std::array<Demand, 27> kDemands{{
    {"axis_drag_N_s2_per_m2", 5, kAllDrag},
    {"force_per_duty_N_per_pct", 1,
     [](const RigParameters& rig, const Estimate&) { return force_per_duty(rig); }},
    {"fsm_drag_N_s2_per_m2", 2, kAllDrag},
    {"mcd_drag_N_s2_per_m2", 2, kAllDrag},
    {"mbdp_drag_N_s2_per_m2", 2, kAllDrag},
    {"mbdp_near_drag_N_s2_per_m2", 1, kAllDrag},
    {"mbdp_middle_drag_N_s2_per_m2", 1, kAllDrag},
    {"curved_fsm_drag_N_s2_per_m2", 5, kAllDrag},
    {"curved_mcd_drag_N_s2_per_m2", 5, kAllDrag},
    {"heading_drag_N_s2_per_m2", 5, kAllDrag},
    {"yaw_drag_N_s2_per_m2", 5, drag_at_yaw},
    {"body_drag_N_s2_per_m2", 5, kObjectDrag},
    {"across_drag_ratio", 5,
     [](const RigParameters& rig, const Estimate&) { return rig.water.object.across_drag_ratio; }},
    {"object_drag_N_s2_per_m2", 3, kObjectDrag},
    {"fsm_added_mass_kg", 10, kAddedMass},
    {"held_thrust_N", 5, kThrust},
    {"towed_thrust_N", 5, kThrust},
    {"thrust_frequency_Hz", 1,
     [](const RigParameters& rig, const Estimate&) { return rig.water.fin.thrust_frequency_Hz; }},
    {"side_frequency_Hz", 1,
     [](const RigParameters& rig, const Estimate&) {
       return 0.5 * rig.water.fin.thrust_frequency_Hz;
     }},
    {"sine_drag_N_s2_per_m2", 10, kAllDrag},
    {"fsm_drag_N", 0, kDragAtSpeed},
    {"mcd_drag_N", 0, kDragAtSpeed},
    {"mbdp_drag_N", 0, kDragAtSpeed},
    {"object_drag_N", 0,
     [](const RigParameters& rig, const Estimate& estimate) {
       return object_drag(rig) * std::pow(estimate.at.value_or(0), 2);
     }},
    {"shaft_drag_N_s2_per_m2", 0,
     [](const RigParameters& rig, const Estimate&) {
       return rig.water.shaft.quadratic_drag_N_s2_per_m2;
     }},
    {"mcd_added_mass_kg", 0, kAddedMass},
    {"thrust_amplitude_N", 0,
     [](const RigParameters& rig, const Estimate&) { return rig.water.fin.thrust_amplitude_N; }},
}};

double bias_of(const RigParameters& rig, const procedures::TowOutcome& outcome,
               const Estimate& estimate) {
  for (const auto& blind : outcome.blind) {
    if (blind.quantity == estimate.quantity) {
      return blind_model_drag_bias(rig.axes[core::Axis::kY].plant, blind.identified, blind.towed);
    }
  }
  return 0;
}

}  // namespace

std::vector<Recovery> judge_tow(const RigParameters& towed, const procedures::TowOutcome& outcome) {
  std::vector<Recovery> judged;
  for (const auto& estimate : outcome.estimates) {
    const auto* demand = std::find_if(kDemands.begin(), kDemands.end(), [&](const Demand& each) {
      return each.quantity == estimate.quantity;
    });
    if (demand == kDemands.end()) {
      continue;
    }
    Recovery one;
    one.estimate = estimate;
    const double plain = demand->truth(towed, estimate);
    one.truth = plain + bias_of(towed, outcome, estimate);
    one.tolerance_pct = demand->tolerance_pct;
    // A bias is judged in per cent of the drag itself.
    one.error_pct = 100.0 * (estimate.value - one.truth) / plain;
    one.width_pct = 100.0 * (estimate.high - estimate.low) / std::fabs(plain);
    const bool demanded = one.tolerance_pct > 0;
    one.agrees = !demanded || std::fabs(one.error_pct) <= one.tolerance_pct;
    one.narrow = !demanded || one.width_pct <= 4.0 * one.tolerance_pct;
    one.covered =
        estimate.no_interval.empty() && estimate.low <= one.truth && one.truth <= estimate.high;
    judged.push_back(std::move(one));
  }
  return judged;
}

}  // namespace towbench::study
