#include "study/procedures/switch_study.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "study/procedures/believed_model.h"
#include "study/procedures/procedures.h"
#include "study/statistics/statistics.h"

namespace towbench::study::procedures {
namespace {

double stiffness_Nm_per_rad(const Transmission& transmission) {
  const double load = transmission.inertia_kg_m2 - transmission.rotor_kg_m2;
  const double w = 2 * std::numbers::pi * transmission.resonance_Hz;
  return w * w * transmission.rotor_kg_m2 * load / transmission.inertia_kg_m2;
}

// What of the torque the motor's own friction takes, (3.25).
double own_friction_Nm(const Transmission& transmission, double rad_per_s) {
  const double ratio = rad_per_s / transmission.stribeck_rad_per_s;
  return (1 - transmission.carriage_share) *
         (transmission.common_Nm + transmission.excess_Nm * std::exp(-ratio * ratio) +
          transmission.viscous_Nm_s_per_rad * rad_per_s);
}

}  // namespace

// What the pulses found, else belief, which may be off by a fifth.
KnownTransmission known_transmission(const ProcedureContext& context) {
  constexpr double kBelieved = 0.2;
  const auto axis = believed_axis(context);
  const auto scale = torque_scale(context);
  KnownTransmission known{.transmission = {}, .doubts = {}, .identified = true};
  auto& transmission = known.transmission;
  transmission.rotor_kg_m2 = axis.rotor_inertia_kg_m2;
  transmission.viscous_Nm_s_per_rad = axis.viscous_friction_Nm_s_per_rad;
  transmission.torque_per_duty_Nm = scale.torque_per_duty_Nm;
  known.doubts.push_back(
      {&Transmission::torque_per_duty_Nm,
       scale.torque_per_duty_Nm * (scale.measured ? scale.relative_standard_error : kBelieved)});
  const auto take = [&](double Transmission::*what, const char* quantity, double belief) {
    const auto* found = context.find(quantity);
    known.identified = known.identified && found != nullptr;
    transmission.*what = found != nullptr ? found->value : belief;
    known.doubts.push_back({what, found != nullptr ? found->half_width() / statistics::kNormal95
                                                   : kBelieved * belief});
  };
  take(&Transmission::inertia_kg_m2, "inertia_kg_m2", axis.inertia_kg_m2);
  take(&Transmission::resonance_Hz, "transmission_resonance_Hz", axis.elasticity.resonance_Hz);
  take(&Transmission::damping_ratio, "transmission_damping_ratio", axis.elasticity.damping_ratio);
  take(&Transmission::carriage_share, "friction_carriage_share", axis.friction.carriage_share);
  take(&Transmission::common_Nm, "friction_common_Nm", axis.coulomb_friction_Nm);
  take(&Transmission::excess_Nm, "stiction_excess_Nm",
       axis.friction.breakaway_Nm - axis.coulomb_friction_Nm);
  take(&Transmission::stribeck_rad_per_s, "stribeck_speed_rad_per_s",
       axis.friction.stribeck_speed_rad_per_s);
  return known;
}

SwitchStudy::SwitchStudy(const identify::Recording& data, core::Axis axis,
                         const std::vector<identify::SwitchApproach>& approaches)
    : data_(data),
      axis_(axis),
      approaches_(approaches),
      counts_(identify::counts_in_one_frame(data, axis, approaches)) {}

Distance Edges::weighed() const noexcept {
  const double of_slow = 1 / (slow.standard_error_counts * slow.standard_error_counts);
  const double of_fast = 1 / (fast.standard_error_counts * fast.standard_error_counts);
  const double all = of_slow + of_fast;
  return {
      .counts = (of_slow * slow.counts + of_fast * fast.counts) / all,
      .standard_error_counts = 1 / std::sqrt(all),
      .alike_counts = std::hypot(of_slow * slow.alike_counts, of_fast * fast.alike_counts) / all};
}

Edges SwitchStudy::edges(const Transmission& transmission) const {
  Edges edges{.slow = between(transmission, &identify::SwitchApproach::slow_edge),
              .fast = between(transmission, &identify::SwitchApproach::fast_edge)};
  for (const auto& each : approaches_) {
    edges.motor_counts +=
        each.outward * 0.5 * (counts_[each.slow_edge] + counts_[each.slow_edge + 1]);
  }
  return edges;
}

// The switch closed somewhere between a row and the next one.
Distance SwitchStudy::between(const Transmission& transmission,
                              std::size_t identify::SwitchApproach::*edge) const {
  constexpr double kSomewhere = 0.29;  // 1/sqrt(12) of a row
  Distance distance;
  double square = 0;
  double alike_square = 0;
  for (const auto& each : approaches_) {
    const std::size_t row = each.*edge;
    const auto ahead = lead(transmission, each, row);
    const double way = kSomewhere * (counts_[row + 1] - counts_[row]);
    distance.counts += each.outward * 0.5 * (counts_[row] + counts_[row + 1]) - ahead.counts;
    square += way * way + ahead.rounding_counts * ahead.rounding_counts;
    alike_square += ahead.hidden_counts * ahead.hidden_counts;
  }
  distance.standard_error_counts = std::sqrt(square + alike_square);
  distance.alike_counts = std::sqrt(alike_square);
  return distance;
}

double SwitchStudy::beyond_m(const identify::SwitchApproach& each) const {
  double beyond = 0;
  for (std::size_t k = each.fast_from; k < each.declared; ++k) {
    beyond = std::max(beyond, each.outward * (counts_[k] - counts_[each.slow_edge]));
  }
  return beyond * data_.metres_per_count[axis_];
}

namespace {

// Over the last `rows` rows up to `edge`, carried on to half a row beyond it.
struct Trend {
  double value = 0;
  double per_row = 0;
};
template <typename Column>
Trend straight_line(const Column& column, std::size_t edge, std::size_t rows) {
  const std::size_t from = edge + 1 > rows ? edge + 1 - rows : 0;
  const auto n = static_cast<double>(edge + 1 - from);
  double mean = 0;
  double moment = 0;
  double square = 0;
  for (std::size_t k = from; k <= edge; ++k) {
    const double t = static_cast<double>(k - from) - 0.5 * (n - 1);
    mean += column[k] / n;
    moment += t * column[k];
    square += t * t;
  }
  const double slope = moment / square;
  return {.value = mean + slope * 0.5 * n, .per_row = slope};
}

}  // namespace

// By straight lines through a seventh of a swing: the transmission's stretch may be on its way
// while the carriage sticks and slips.
SwitchStudy::Moment SwitchStudy::moment_at(const Transmission& transmission,
                                           const identify::SwitchApproach& approach,
                                           std::size_t edge) const {
  constexpr double kOfASwing = 0.15;
  constexpr std::size_t kFewest = 8;
  const double held_s = std::sqrt(transmission.inertia_kg_m2 / transmission.rotor_kg_m2) /
                        transmission.resonance_Hz;  // motor held
  const auto rows =
      std::max(kFewest, static_cast<std::size_t>(std::lround(kOfASwing * held_s / data_.period_s)));
  const auto duty = straight_line(data_.axes[axis_].duty_pct, edge, rows);
  const auto last = straight_line(counts_, edge, rows);
  const auto before = straight_line(counts_, edge - rows, rows);
  const double per_s = 1 / data_.period_s;
  const double rad_per_count = approach.outward * data_.rad_per_count[axis_];
  const double acceleration =
      (last.per_row - before.per_row) / static_cast<double>(rows) * rad_per_count * per_s * per_s;
  // Rounding to a count leaves a line's slope sqrt(12 / n^3) of 1/sqrt(12) counts a row off.
  const auto n = static_cast<double>(rows);
  // The slope of a stretch is the speed in its middle.
  const double since_s = 0.5 * static_cast<double>(rows) * data_.period_s;
  return {
      .torque_Nm = approach.outward * duty.value * transmission.torque_per_duty_Nm,
      .torque_Nm_per_s = approach.outward * duty.per_row * transmission.torque_per_duty_Nm * per_s,
      .speed_rad_per_s = last.per_row * rad_per_count * per_s + acceleration * since_s,
      .acceleration_rad_per_s2 = acceleration,
      .acceleration_standard_error =
          std::sqrt(2 / (n * n * n * n * n)) * data_.rad_per_count[axis_] * per_s * per_s};
}

SwitchStudy::Lead SwitchStudy::lead(const Transmission& transmission,
                                    const identify::SwitchApproach& approach,
                                    std::size_t edge) const {
  // In a slip all of this changes within a few rows; straight lines were seen to miss by what two
  // to four rows change.
  constexpr double kLeftOut_rows = 3;
  constexpr double kLeast_counts = 1;
  const auto moment = moment_at(transmission, approach, edge);
  const double counts_per_Nm = 1 / stiffness_Nm_per_rad(transmission) / data_.rad_per_count[axis_];
  const double transmission_Nm =
      moment.torque_Nm - own_friction_Nm(transmission, std::max(0.0, moment.speed_rad_per_s)) -
      transmission.rotor_kg_m2 * moment.acceleration_rad_per_s2;
  const double changes = moment.torque_Nm_per_s * counts_per_Nm;  // counts per s
  const double damping_s =
      transmission.damping_ratio / (std::numbers::pi * transmission.resonance_Hz);  // 2 zeta / w_0
  return {.counts = transmission_Nm * counts_per_Nm - damping_s * changes,
          .rounding_counts =
              transmission.rotor_kg_m2 * moment.acceleration_standard_error * counts_per_Nm,
          .hidden_counts = std::hypot(kLeast_counts, kLeftOut_rows * data_.period_s * changes)};
}

}  // namespace towbench::study::procedures
