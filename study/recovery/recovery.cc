#include "study/recovery/recovery.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <span>

#include "core/axis.h"

namespace towbench::study {
namespace {

using emulator::RigAxisParameters;
using identify::Estimate;

// tau_P of (3.34): piecewise linear, constant beyond its ends.
double position_friction_Nm(const emulator::AxisParameters& plant, double position_m) {
  const auto& table = plant.friction.position;
  if (table.position_m.size() == 0) {
    return 0;
  }
  std::size_t above = 0;
  while (above < table.position_m.size() && table.position_m[above] <= position_m) {
    ++above;
  }
  if (above == 0) {
    return table.friction_Nm[0];
  }
  if (above == table.position_m.size()) {
    return table.friction_Nm[above - 1];
  }
  const double share = (position_m - table.position_m[above - 1]) /
                       (table.position_m[above] - table.position_m[above - 1]);
  return table.friction_Nm[above - 1] +
         share * (table.friction_Nm[above] - table.friction_Nm[above - 1]);
}

double position_friction_at(const emulator::AxisParameters& plant, const Estimate& estimate) {
  return estimate.at ? position_friction_Nm(plant, *estimate.at) : 0.0;
}

// Where back EMF and the winding's drop use up the amplifier's voltage:
//   V = R i + K_T w,  K_T i = B w + C + tau_P,  V = 0.9 (V_0 - R_s P / V_0),  P = V i / efficiency
double saturation_speed_m_per_s(const emulator::RigParameters& rig, const RigAxisParameters& axis,
                                const Estimate& estimate) {
  const auto& p = axis.plant;
  const double dry_Nm = p.coulomb_friction_Nm + position_friction_at(p, estimate);
  const double k = p.torque_constant_Nm_per_A;
  double supply_V = rig.supply.voltage_V;
  double speed = 0;
  for (int i = 0; i < 20; ++i) {
    const double limit_V = p.amplifier.output_limit_ratio * supply_V;
    speed = (limit_V - p.winding.resistance_ohm * dry_Nm / k) /
            (k + p.winding.resistance_ohm * p.viscous_friction_Nm_s_per_rad / k);
    const double current_A = (dry_Nm + p.viscous_friction_Nm_s_per_rad * speed) / k;
    const double drawn_A = limit_V * current_A / rig.supply.amplifier_efficiency / supply_V;
    supply_V = rig.supply.voltage_V - rig.supply.source_resistance_ohm * drawn_A;
  }
  return speed * p.output_radius_m / p.gear_ratio;
}

double inertia_over_friction_s(const emulator::AxisParameters& p) {
  return p.inertia_kg_m2 / p.viscous_friction_Nm_s_per_rad;
}

// A step of torque k D for one time constant J/B, from rest, reaches (k D - C - tau_P)/B (1 - 1/e);
// the least that reaches 98 % of the saturation speed w_s:
//   D = (C + tau_P + 0.98 B w_s / (1 - 1/e)) / k
double smallest_command_pct(const emulator::RigParameters& rig, const RigAxisParameters& axis,
                            const Estimate& estimate) {
  constexpr double kArrived = 0.98;
  const auto& p = axis.plant;
  const double speed =
      saturation_speed_m_per_s(rig, axis, estimate) * p.gear_ratio / p.output_radius_m;
  const double torque_Nm =
      p.coulomb_friction_Nm + position_friction_at(p, estimate) +
      kArrived * p.viscous_friction_Nm_s_per_rad * speed / (1 - std::exp(-1.0));
  return 100 * torque_Nm /
         (p.torque_constant_Nm_per_A * p.amplifier_gain_A_per_V * axis.command.pwm_amplitude_V);
}

// ID-5: within 10 counts, here as a share of the distance.
double ten_counts_pct(const RigAxisParameters& axis) {
  const double metres_per_count = 2 * std::numbers::pi /
                                  static_cast<double>(axis.encoder.counts_per_turn) *
                                  axis.plant.output_radius_m / axis.plant.gear_ratio;
  return 100 * 10 * metres_per_count / (axis.hall_max.position_m - axis.hall_min.position_m);
}

// What must be overcome to leave rest towards max, the way the ramps go: dry friction of that way
// (of the place alike both ways), gravity on a tilted rail, a cable's pull.
double breakaway_Nm(const emulator::AxisParameters& p, const Estimate& estimate) {
  constexpr double kGravity_m_per_s2 = 9.80665;
  const double metres_per_motor_rad = p.output_radius_m / p.gear_ratio;
  const double carriage_kg =
      (p.inertia_kg_m2 - p.rotor_inertia_kg_m2) / (metres_per_motor_rad * metres_per_motor_rad);
  const auto& pushes = p.disturbances;
  const double force_N =
      carriage_kg * kGravity_m_per_s2 * std::sin(pushes.tilt_deg * std::numbers::pi / 180) +
      pushes.cable.stiffness_N_per_m * (estimate.at.value_or(0) - pushes.cable.reference_m);
  return p.friction.breakaway_Nm * (1 + p.friction.options.asymmetry.breakaway) +
         position_friction_at(p, estimate) + force_N * metres_per_motor_rad;
}

struct Demand {
  std::string_view quantity;
  double tolerance_pct;  // 0: absolute, see tolerance_pct()
  double (*truth)(const emulator::RigParameters&, const RigAxisParameters&, const Estimate&);
};

// ID-1 to ID-10 of docs/requirements.md.
const std::array<Demand, 20> kDemands{{
    {"torque_constant_Nm_per_A", 1,
     [](const auto&, const auto& a, const auto&) { return a.plant.torque_constant_Nm_per_A; }},
    {"amplifier_gain_A_per_V", 1,
     [](const auto&, const auto& a, const auto&) { return a.plant.amplifier_gain_A_per_V; }},
    {"mechanical_time_constant_s", 10,
     [](const auto&, const auto& a, const auto&) { return inertia_over_friction_s(a.plant); }},
    {"saturation_speed_m_per_s", 2, saturation_speed_m_per_s},
    {"hall_min_m", 100,
     [](const auto&, const auto& a, const auto&) { return a.hall_min.position_m; }},
    {"hall_max_m", 1,
     [](const auto&, const auto& a, const auto&) { return a.hall_max.position_m; }},
    {"breakaway_Nm", 5,
     [](const auto&, const auto& a, const auto& e) { return breakaway_Nm(a.plant, e); }},
    {"inertia_kg_m2", 3,
     [](const auto&, const auto& a, const auto&) { return a.plant.inertia_kg_m2; }},
    {"viscous_friction_Nm_s_per_rad", 10,
     [](const auto&, const auto& a, const auto&) { return a.plant.viscous_friction_Nm_s_per_rad; }},
    {"coulomb_friction_Nm", 5,
     [](const auto&, const auto& a, const auto& e) {
       return a.plant.coulomb_friction_Nm + position_friction_at(a.plant, e);
     }},
    {"sliding_friction_Nm", 10,
     [](const auto&, const auto& a, const auto& e) {
       return a.plant.coulomb_friction_Nm + position_friction_at(a.plant, e);
     }},
    {"steady_viscous_Nm_s_per_rad", 10,
     [](const auto&, const auto& a, const auto&) { return a.plant.viscous_friction_Nm_s_per_rad; }},
    {"transmission_resonance_Hz", 2,
     [](const auto&, const auto& a, const auto&) { return a.plant.elasticity.resonance_Hz; }},
    {"transmission_damping_ratio", 20,
     [](const auto&, const auto& a, const auto&) { return a.plant.elasticity.damping_ratio; }},
    {"smallest_command_pct", 0, smallest_command_pct},
    {"hall_distance_m", 0,
     [](const auto&, const auto& a, const auto&) {
       return a.hall_max.position_m - a.hall_min.position_m;
     }},
    {"map_coulomb_Nm", 10,
     [](const auto&, const auto& a, const auto& e) {
       return a.plant.coulomb_friction_Nm + position_friction_at(a.plant, e);
     }},
    {"map_viscous_Nm_s_per_rad", 10,
     [](const auto&, const auto& a, const auto&) { return a.plant.viscous_friction_Nm_s_per_rad; }},
    {"map_stribeck_rad_per_s", 10,
     [](const auto&, const auto& a, const auto&) {
       return a.plant.friction.stribeck_speed_rad_per_s;
     }},
    {"stribeck_speed_rad_per_s", 10,
     [](const auto&, const auto& a, const auto&) {
       return a.plant.friction.stribeck_speed_rad_per_s;
     }},
}};

// EXP-P-4: "bracketed to 0.5 % duty", so the bracket's middle is half of that off at most.
constexpr double kBracket_pct_duty = 0.5;

double tolerance_pct(const Demand& demand, const RigAxisParameters& axis, double truth) {
  if (demand.tolerance_pct > 0) {
    return demand.tolerance_pct;
  }
  return demand.truth == smallest_command_pct ? 100 * 0.5 * kBracket_pct_duty / truth
                                              : ten_counts_pct(axis);
}

const Demand* demand_on(const Estimate& estimate) {
  const auto* found = std::find_if(kDemands.begin(), kDemands.end(), [&](const Demand& each) {
    return each.quantity == estimate.quantity;
  });
  return found == kDemands.end() ? nullptr : found;
}

}  // namespace

std::optional<double> truth_of(const emulator::RigParameters& rig, const Estimate& estimate) {
  const auto* demand = demand_on(estimate);
  if (demand == nullptr || estimate.axis.empty()) {
    return std::nullopt;
  }
  const auto which = estimate.axis == "x" ? core::Axis::kX : core::Axis::kY;
  return demand->truth(rig, rig.axes[which], estimate);
}

std::vector<Recovery> judge_recovery(const emulator::RigParameters& rig,
                                     const identify::Estimates& estimates) {
  std::vector<Recovery> recoveries;
  for (const auto& estimate : estimates) {
    const auto truth = truth_of(rig, estimate);
    if (!truth) {
      continue;
    }
    Recovery recovery{.estimate = estimate, .truth = *truth};
    const double percent = 100 / std::fabs(*truth);
    const auto which = estimate.axis == "x" ? core::Axis::kX : core::Axis::kY;
    recovery.tolerance_pct = tolerance_pct(*demand_on(estimate), rig.axes[which], *truth);
    recovery.error_pct = (estimate.value - *truth) * percent;
    recovery.width_pct = (estimate.high - estimate.low) * percent;
    recovery.agrees = std::fabs(recovery.error_pct) <= recovery.tolerance_pct;
    recovery.narrow = recovery.width_pct <= 4 * recovery.tolerance_pct;
    recovery.covered = estimate.low <= *truth && *truth <= estimate.high;
    recoveries.push_back(std::move(recovery));
  }
  return recoveries;
}

PooledCoverage pooled(const std::vector<Recovery>& recoveries) {
  PooledCoverage coverage;
  for (const auto& each : recoveries) {
    ++coverage.estimates;
    coverage.covered += each.covered ? 1U : 0U;
  }
  return coverage;
}

}  // namespace towbench::study
