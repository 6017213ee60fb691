#include "study/procedures/pulse_start.h"

#include <algorithm>
#include <cmath>

#include "study/identify/bent_line.h"
#include "study/procedures/believed_model.h"
#include "study/procedures/procedures.h"

namespace towbench::study::procedures {
namespace {

// Estimates of a map along this axis, in order of place.
std::vector<identify::Estimate> map_of(const ProcedureContext& context, std::string_view quantity) {
  std::vector<identify::Estimate> map;
  for (const auto& each : context.known) {
    if (each.quantity == quantity && each.axis == core::name_of(context.axis) && each.at) {
      map.push_back(each);
    }
  }
  std::sort(map.begin(), map.end(),
            [](const auto& one, const auto& other) { return *one.at < *other.at; });
  return map;
}

std::vector<double> even_knots(double from, double to, double spacing_m) {
  const int pieces = std::clamp(static_cast<int>(std::lround((to - from) / spacing_m)), 1, 12);
  std::vector<double> knots;
  for (int i = 0; i <= pieces; ++i) {
    knots.push_back(from + (to - from) * i / pieces);
  }
  return knots;
}

// Break-away above sliding friction where both were measured, as a mean over the places.
double excess_of(const ProcedureContext& context, const identify::BentLine& sliding) {
  double sum = 0;
  const auto breakaways = map_of(context, "breakaway_Nm");
  for (const auto& each : breakaways) {
    sum += each.value - sliding.at(*each.at);
  }
  return breakaways.empty() ? 0 : sum / static_cast<double>(breakaways.size());
}

}  // namespace

identify::TwoMassStart pulse_start(const ProcedureContext& context, const identify::Recording& data,
                                   double spacing_m) {
  // A bend nearer to an end of the pulses than that cannot be told from the end's own level.
  constexpr double kNearEnd = 0.03;
  constexpr double kBendKnown = 0.02;  // of the way: three times what bends were seen to be off
  constexpr double kLeastLoad = 1.05;  // J over the rotor's own
  identify::TwoMassStart start{.axis = believed_axis(context), .path = believed_path(context)};
  // The swing that a coast shows is the free-free mode itself.
  start.axis.elasticity.resonance_Hz =
      value_or(context, "swing_Hz", start.axis.elasticity.resonance_Hz);
  start.stribeck_known = 0.7;
  start.excess_known = 0.5;
  start.rotor_known = torque_scale(context).relative_standard_error;
  const auto& counts = data.axes[context.axis].count;
  const auto [low, high] = std::minmax_element(counts.begin(), counts.end());
  const double from = static_cast<double>(*low) * data.metres_per_count[context.axis];
  const double to = static_cast<double>(*high) * data.metres_per_count[context.axis];
  const auto map = map_of(context, "sliding_friction_Nm");
  if (map.size() < 2) {
    start.knots_m = even_knots(from, to, spacing_m);
    return start;
  }
  identify::BentLine sliding;
  for (const auto& each : map) {
    sliding.x.push_back(*each.at);
    sliding.y.push_back(each.value);
  }
  const double margin = kNearEnd * (to - from);
  start.knots_m.push_back(from);
  for (std::size_t i = 1; i + 1 < sliding.x.size(); ++i) {
    if (sliding.x[i] > from + margin && sliding.x[i] < to - margin) {
      start.knots_m.push_back(sliding.x[i]);
    }
  }
  start.knots_m.push_back(to);
  start.knots_known_m = kBendKnown * (to - from);
  for (const double knot : start.knots_m) {
    start.coulomb_Nm.push_back(sliding.at(knot));
  }
  start.axis.viscous_friction_Nm_s_per_rad =
      value_or(context, "steady_viscous_Nm_s_per_rad", start.axis.viscous_friction_Nm_s_per_rad);
  // J/B of the coasts: from the inertia that was believed the search may end beside the swing.
  if (const auto* time_s = context.find("mechanical_time_constant_s")) {
    start.axis.inertia_kg_m2 = std::max(time_s->value * start.axis.viscous_friction_Nm_s_per_rad,
                                        kLeastLoad * start.axis.rotor_inertia_kg_m2);
  }
  start.axis.coulomb_friction_Nm =
      *std::min_element(start.coulomb_Nm.begin(), start.coulomb_Nm.end());
  const double excess = excess_of(context, sliding);
  if (excess > 0.05 * start.axis.coulomb_friction_Nm) {
    start.axis.friction.breakaway_Nm = start.axis.coulomb_friction_Nm + excess;
    start.excess_known = 0.2;
  }
  return start;
}

}  // namespace towbench::study::procedures
