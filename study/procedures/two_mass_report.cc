#include "study/procedures/two_mass_report.h"

#include <algorithm>
#include <cmath>
#include <initializer_list>
#include <optional>
#include <string_view>

#include <fmt/format.h>

#include "study/procedures/believed_model.h"
#include "study/procedures/least_squares_report.h"
#include "study/procedures/procedures.h"

namespace towbench::study::procedures {
namespace {

// The origin of a log is where a hand put the axis: evenly spread over 1 mm to each side.
constexpr double kOrigin_m = 0.58e-3;  // 1 mm / sqrt(3)
// What quantisation leaves is 1/sqrt(12) of a count (a right model was seen to leave 0.285). A fit
// that leaves more has bent its parameters round something that it does not know; its intervals
// hold by how much (identify/model_error.h), and what they hold to no better than half is withheld.
constexpr double kMostLeft_counts = 2;
constexpr double kWidest = 0.5;
constexpr double kRight_counts = 0.5;  // as the search has it (identify/output_error.cc)

struct Found {
  const char* quantity;
  double value;
  double standard_error;
  const char* unit;
  bool is_torque = false;  // has the error of the torque of a duty, too
  std::optional<double> at = std::nullopt;
};

// Reports an estimate, or withholds it where the model is wrong and the interval too wide.
class EstimateWriter {
 public:
  EstimateWriter(const TwoMassReport& report, ProcedureOutcome& outcome)
      : report_(report), outcome_(outcome), torque_(torque_scale(report.context)) {}

  void add(const Found& found) {
    auto estimate = identify::with_standard_error(estimate_of(found), whole_error_of(found));
    // A Stribeck speed means another one in each form of the law.
    const bool formless = found.quantity == std::string_view("stribeck_speed_rad_per_s");
    const double share = estimate.half_width() / std::fabs(found.value);
    if (report_.fit.residual_rms_counts <= kRight_counts || (!formless && share <= kWidest)) {
      outcome_.estimates.push_back(std::move(estimate));
      return;
    }
    outcome_.withheld.push_back(identify::withheld(
        std::move(estimate),
        fmt::format("{:.3g} {} +-{:.0f} %: the two-mass model leaves {:.1f} counts RMS of the "
                    "pulses",
                    found.value, found.unit, 100 * share, report_.fit.residual_rms_counts)));
  }

 private:
  [[nodiscard]] double whole_error_of(const Found& found) const {
    return std::hypot(found.standard_error,
                      found.is_torque ? found.value * torque_.relative_standard_error : 0.0);
  }
  [[nodiscard]] identify::Estimate estimate_of(const Found& found) const {
    return {
        .quantity = found.quantity,
        .axis = std::string(core::name_of(report_.context.axis)),
        .value = found.value,
        .unit = found.unit,
        .rests_on = fmt::format(
            "output error of the two-mass model over {} rows, residual {:.2f} counts; torque by {}",
            report_.data.rows(), report_.fit.residual_rms_counts,
            torque_.measured ? "EXP-P-1"
                             : "the believed K_T K_amp, whose error is not in the interval"),
        .procedure = report_.procedure,
        .at = found.at};
  }

  const TwoMassReport& report_;
  ProcedureOutcome& outcome_;
  TorqueScale torque_;
};

void add_constants(const identify::TwoMassFit& fit, EstimateWriter& estimates) {
  const auto& axis = fit.axis;
  for (const Found& found : std::initializer_list<Found>{
           {"inertia_kg_m2", axis.inertia_kg_m2, fit.inertia_standard_error, "kg m2", true},
           {"viscous_friction_Nm_s_per_rad", axis.viscous_friction_Nm_s_per_rad,
            fit.viscous_standard_error, "N m s/rad", true},
           {"rotor_inertia_kg_m2", axis.rotor_inertia_kg_m2, fit.rotor_standard_error, "kg m2"},
           {"transmission_resonance_Hz", axis.elasticity.resonance_Hz,
            fit.resonance_standard_error_Hz, "Hz"},
           {"transmission_damping_ratio", axis.elasticity.damping_ratio, fit.damping_standard_error,
            "1"},
           {"friction_common_Nm", axis.coulomb_friction_Nm, fit.common_standard_error_Nm, "N m",
            true},
           {"friction_carriage_share", axis.friction.carriage_share, fit.share_standard_error, "1"},
           {"stribeck_speed_rad_per_s", axis.friction.stribeck_speed_rad_per_s,
            fit.stribeck_standard_error, "rad/s"},
           {"stiction_excess_Nm", fit.excess_Nm, fit.excess_standard_error_Nm, "N m", true},
           {kLeftByPulses, fit.residual_rms_counts, 0, "counts RMS"}}) {
    estimates.add(found);
  }
}

// Its knots' places are known as well as the log's origin; between knots it may bend where no knot
// is.
void add_friction_map(const TwoMassReport& report, EstimateWriter& estimates) {
  const auto& knots = report.fit.knots_m;
  const auto& friction_Nm = report.fit.coulomb_Nm;
  const auto slope = [&](std::size_t i) {
    return (friction_Nm[i + 1] - friction_Nm[i]) / (knots[i + 1] - knots[i]);
  };
  for (std::size_t i = 0; i < knots.size(); ++i) {
    const bool has_next = i + 1 < knots.size();
    const double steepest =
        std::max(i > 0 ? std::fabs(slope(i - 1)) : 0.0, has_next ? std::fabs(slope(i)) : 0.0);
    double bend = 0;
    if (!report.knots_are_bends && i > 0 && has_next) {
      bend = std::fabs(friction_Nm[i - 1] - 2 * friction_Nm[i] + friction_Nm[i + 1]) / 8;
    }
    estimates.add({"coulomb_friction_Nm", friction_Nm[i],
                   std::hypot(report.fit.coulomb_standard_error_Nm[i], bend, steepest * kOrigin_m),
                   "N m", true, knots[i]});
  }
}

void add_figures(const TwoMassReport& report, ProcedureOutcome& outcome) {
  const auto& context = report.context;
  const auto& data = report.data;
  const auto& fit = report.fit;
  auto figure = speed_figure(data, context.axis, "Pulse responses");
  figure.curves[0].name = "measured";
  figure.caption = "Measured and simulated with the estimates; compare Figs 7.4 to 7.6.";
  Curve simulated{.name = "simulated"};
  Curve residual{.name = "measured - simulated"};
  constexpr std::size_t kSpan = 10;
  const std::size_t every = std::max<std::size_t>(1, data.rows() / 2000);
  for (std::size_t k = kSpan; k < data.rows(); k += every) {
    simulated.x.push_back(data.time_s[k]);
    simulated.y.push_back((fit.simulated_counts[k] - fit.simulated_counts[k - kSpan]) *
                          data.metres_per_count[context.axis] /
                          (data.time_s[k] - data.time_s[k - kSpan]));
    residual.x.push_back(data.time_s[k]);
    residual.y.push_back(
        1e3 * data.metres_per_count[context.axis] *
        (static_cast<double>(data.axes[context.axis].count[k]) + 0.5 - fit.simulated_counts[k]));
  }
  figure.curves.push_back(std::move(simulated));
  outcome.figures.push_back(std::move(figure));
  outcome.figures.push_back({.title = "What the model leaves, from one end of the run to the other",
                             .x_label = "time, s",
                             .y_label = "position, mm",
                             .curves = {std::move(residual)}});
}

}  // namespace

std::string unexplained(const identify::TwoMassFit& fit) {
  return !fit.converged || fit.simulated_counts.empty()
             ? "output error did not converge: " + fit.message
             : std::string();
}

bool leaves_much(const identify::TwoMassFit& fit) {
  return fit.residual_rms_counts > kMostLeft_counts;
}

void report_two_mass(const TwoMassReport& report, ProcedureOutcome& outcome) {
  EstimateWriter estimates(report, outcome);
  add_constants(report.fit, estimates);
  add_friction_map(report, estimates);
  report_least_squares(report, outcome);
  add_figures(report, outcome);
}

}  // namespace towbench::study::procedures
