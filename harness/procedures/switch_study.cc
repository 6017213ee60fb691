#include "harness/procedures/switch_study.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "harness/procedures/believed_model.h"
#include "harness/procedures/procedures.h"

namespace towbench::harness::procedures {
namespace {

double stiffness_Nm_per_rad(const Chain& chain) {
  const double load = chain.inertia_kg_m2 - chain.rotor_kg_m2;
  const double w = 2 * std::numbers::pi * chain.resonance_Hz;
  return w * w * chain.rotor_kg_m2 * load / chain.inertia_kg_m2;
}

// What of the torque the motor keeps for itself at a steady speed, (3.25).
double own_friction_Nm(const Chain& chain, double rad_per_s) {
  const double ratio = rad_per_s / chain.stribeck_rad_per_s;
  return (1 - chain.carriage_share) *
         (chain.common_Nm + chain.excess_Nm * std::exp(-ratio * ratio) +
          chain.viscous_Nm_s_per_rad * rad_per_s);
}

}  // namespace

// What the pulses found, else belief, which may be off by a fifth.
KnownChain known_chain(const ProcedureContext& context) {
  constexpr double kNormal95 = 1.959964;
  constexpr double kBelieved = 0.2;
  const auto axis = believed_axis(context);
  const auto scale = torque_scale(context);
  KnownChain known{.chain = {}, .doubts = {}, .identified = true};
  auto& chain = known.chain;
  chain.rotor_kg_m2 = axis.rotor_inertia_kg_m2;
  chain.viscous_Nm_s_per_rad = axis.viscous_friction_Nm_s_per_rad;
  chain.torque_per_duty_Nm = scale.torque_per_duty_Nm;
  known.doubts.push_back(
      {&Chain::torque_per_duty_Nm,
       scale.torque_per_duty_Nm * (scale.measured ? scale.relative_deviation : kBelieved)});
  const auto take = [&](double Chain::*what, const char* quantity, double belief) {
    const auto* found = context.find(quantity);
    known.identified = known.identified && found != nullptr;
    chain.*what = found != nullptr ? found->value : belief;
    known.doubts.push_back(
        {what, found != nullptr ? found->half_width() / kNormal95 : kBelieved * belief});
  };
  take(&Chain::inertia_kg_m2, "inertia_kg_m2", axis.inertia_kg_m2);
  take(&Chain::resonance_Hz, "chain_resonance_Hz", axis.chain.resonance_Hz);
  take(&Chain::carriage_share, "friction_carriage_share", axis.friction.carriage_share);
  take(&Chain::common_Nm, "friction_common_Nm", axis.coulomb_friction_Nm);
  take(&Chain::excess_Nm, "stiction_excess_Nm",
       axis.friction.breakaway_Nm - axis.coulomb_friction_Nm);
  take(&Chain::stribeck_rad_per_s, "stribeck_speed_rad_per_s",
       axis.friction.stribeck_speed_rad_per_s);
  return known;
}

SwitchStudy::SwitchStudy(const identify::Recording& data, core::Axis axis,
                         const std::vector<identify::SwitchApproach>& approaches)
    : data_(data),
      axis_(axis),
      approaches_(approaches),
      counts_(identify::counts_in_one_frame(data, axis, approaches)) {}

Edges SwitchStudy::edges(const Chain& chain) const {
  Edges edges;
  for (const auto& each : approaches_) {
    const auto motor = [&](std::size_t row) { return 0.5 * (counts_[row] + counts_[row + 1]); };
    edges.motor_counts += each.outward * motor(each.slow_edge);
    edges.slow_counts +=
        each.outward * motor(each.slow_edge) - lead_counts(chain, each, each.slow_edge);
    edges.fast_counts +=
        each.outward * motor(each.fast_edge) - lead_counts(chain, each, each.fast_edge);
  }
  return edges;
}

double SwitchStudy::beyond_m(const identify::SwitchApproach& each) const {
  double beyond = 0;
  for (std::size_t k = each.fast_from; k < each.declared; ++k) {
    beyond = std::max(beyond, each.outward * (counts_[k] - counts_[each.slow_edge]));
  }
  return beyond * data_.metres_per_count[axis_];
}

// A straight line through the duty of the last tenth of a swing, carried on to the edge: the
// chain's stretch may be on its way while the carriage sticks and slips.
double SwitchStudy::duty_at_pct(const Chain& chain, std::size_t edge) const {
  constexpr double kOfASwing = 0.1;
  constexpr std::size_t kFewest = 8;
  const double held_s =
      std::sqrt(chain.inertia_kg_m2 / chain.rotor_kg_m2) / chain.resonance_Hz;  // motor held
  const auto rows =
      std::max(kFewest, static_cast<std::size_t>(std::lround(kOfASwing * held_s / data_.period_s)));
  const std::size_t from = edge + 1 > rows ? edge + 1 - rows : 0;
  const auto n = static_cast<double>(edge + 1 - from);
  double mean = 0;
  double moment = 0;
  double square = 0;
  for (std::size_t k = from; k <= edge; ++k) {
    const double t = static_cast<double>(k - from) - 0.5 * (n - 1);
    mean += data_.axes[axis_].duty_pct[k] / n;
    moment += t * data_.axes[axis_].duty_pct[k];
    square += t * t;
  }
  return mean + moment / square * 0.5 * n;  // half a row beyond the last one
}

double SwitchStudy::lead_counts(const Chain& chain, const identify::SwitchApproach& approach,
                                std::size_t edge) const {
  const double rad_per_s = std::fabs(data_.axes[axis_].reference_velocity_m_per_s[edge]) /
                           data_.metres_per_count[axis_] * data_.rad_per_count[axis_];
  const double torque_Nm = approach.outward * duty_at_pct(chain, edge) * chain.torque_per_duty_Nm;
  return (torque_Nm - own_friction_Nm(chain, rad_per_s)) / stiffness_Nm_per_rad(chain) /
         data_.rad_per_count[axis_];
}

}  // namespace towbench::harness::procedures
