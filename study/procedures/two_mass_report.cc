#include "study/procedures/two_mass_report.h"

#include <algorithm>
#include <cmath>
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

void add_estimates(const TwoMassReport& report, ProcedureOutcome& outcome) {
  const auto& context = report.context;
  const auto& fit = report.fit;
  const auto& knots = fit.knots_m;
  const auto scale = torque_scale(context);
  const auto rests = fmt::format(
      "output error of the two-mass model over {} rows, residual {:.2f} counts; torque by {}",
      report.data.rows(), fit.residual_rms_counts,
      scale.measured ? "EXP-P-1" : "the believed K_T K_amp, whose error is not in the interval");
  const bool right = fit.residual_rms_counts <= kRight_counts;
  const auto add = [&](const char* quantity, double value, double deviation, const char* unit,
                       bool scales, std::optional<double> at = std::nullopt) {
    const double whole = std::hypot(deviation, scales ? value * scale.relative_deviation : 0.0);
    auto estimate = identify::with_deviation({.quantity = quantity,
                                              .axis = std::string(core::name_of(context.axis)),
                                              .value = value,
                                              .unit = unit,
                                              .rests_on = rests,
                                              .procedure = report.procedure,
                                              .at = at},
                                             whole);
    // A Stribeck speed means another one in each form of the law.
    const bool formless = !right && quantity == std::string_view("stribeck_speed_rad_per_s");
    if (formless || (!right && estimate.half_width() > kWidest * std::fabs(value))) {
      const double half_pct = 100 * estimate.half_width() / std::fabs(value);
      outcome.withheld.push_back(identify::withheld(
          std::move(estimate),
          fmt::format("{:.3g} {} +-{:.0f} %: the two-mass model leaves {:.1f} counts RMS of the "
                      "pulses",
                      value, unit, half_pct, fit.residual_rms_counts)));
      return;
    }
    outcome.estimates.push_back(std::move(estimate));
  };
  add("inertia_kg_m2", fit.axis.inertia_kg_m2, fit.inertia_deviation, "kg m2", true);
  add("viscous_friction_Nm_s_per_rad", fit.axis.viscous_friction_Nm_s_per_rad,
      fit.viscous_deviation, "N m s/rad", true);
  add("rotor_inertia_kg_m2", fit.axis.rotor_inertia_kg_m2, fit.rotor_deviation, "kg m2", false);
  add("transmission_resonance_Hz", fit.axis.elasticity.resonance_Hz, fit.resonance_deviation_Hz,
      "Hz", false);
  add("transmission_damping_ratio", fit.axis.elasticity.damping_ratio, fit.damping_deviation, "1",
      false);
  add("friction_common_Nm", fit.axis.coulomb_friction_Nm, fit.common_deviation_Nm, "N m", true);
  add("friction_carriage_share", fit.axis.friction.carriage_share, fit.share_deviation, "1", false);
  add("stribeck_speed_rad_per_s", fit.axis.friction.stribeck_speed_rad_per_s,
      fit.stribeck_deviation, "rad/s", false);
  add("stiction_excess_Nm", fit.excess_Nm, fit.excess_deviation_Nm, "N m", true);
  add(kLeftByPulses, fit.residual_rms_counts, 0, "counts RMS", false);
  const auto slope = [&](std::size_t i) {
    return (fit.coulomb_Nm[i + 1] - fit.coulomb_Nm[i]) / (knots[i + 1] - knots[i]);
  };
  for (std::size_t i = 0; i < knots.size(); ++i) {
    const double steepest = std::max(i > 0 ? std::fabs(slope(i - 1)) : 0.0,
                                     i + 1 < knots.size() ? std::fabs(slope(i)) : 0.0);
    // Between knots the map may bend where no knot is.
    double bend = 0;
    if (!report.knots_are_bends && i > 0 && i + 1 < knots.size()) {
      bend = std::fabs(fit.coulomb_Nm[i - 1] - 2 * fit.coulomb_Nm[i] + fit.coulomb_Nm[i + 1]) / 8;
    }
    add("coulomb_friction_Nm", fit.coulomb_Nm[i],
        std::hypot(fit.coulomb_deviation_Nm[i], bend, steepest * kOrigin_m), "N m", true, knots[i]);
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
  add_estimates(report, outcome);
  report_least_squares(report, outcome);
  add_figures(report, outcome);
}

}  // namespace towbench::study::procedures
