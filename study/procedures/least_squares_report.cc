#include "study/procedures/least_squares_report.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <string>
#include <vector>

#include <fmt/format.h>

#include "study/identify/ordinary_least_squares.h"
#include "study/procedures/believed_model.h"
#include "study/procedures/procedures.h"

namespace towbench::study::procedures {
namespace {

// 7.2.1 filters the transmission's oscillation out before (4.9), by a Gaussian whose width it does
// not state: any cut-off below the transmission's mode is a reading of it. 0.45 is the one that is
// judged.
constexpr double kBelowTheMode = 0.45;
constexpr std::array<double, 6> kSharesOfTheMode{0.25, kBelowTheMode, 0.7, 1.0, 1.5, 2.2};

struct BothFits {
  identify::OlsFit of_machine;
  identify::OlsFit of_reference;  // a machine whose parameters are known: what is off is the bias
};

class LeastSquares {
 public:
  explicit LeastSquares(const TwoMassReport& report) : report_(report) {
    const auto& context = report.context;
    const auto& belief = context.machine.configuration().axes[context.axis];
    input_.torque_per_duty_Nm = torque_scale(context).torque_per_duty_Nm;
    input_.saturation_speed_m_per_s =
        value_or(context, "saturation_speed_m_per_s", belief.speed_limit_m_per_s);
    input_.largest_duty_pct = 100 * belief.drive.current_limit_A /
                              (belief.drive.amplifier_gain_A_per_V * belief.drive.pwm_amplitude_V);
    reference_.resize(report.fit.simulated_counts.size());
    std::transform(report.fit.simulated_counts.begin(), report.fit.simulated_counts.end(),
                   reference_.begin(), [](double count) { return std::floor(count); });
  }

  [[nodiscard]] double cutoff_Hz(double share_of_mode) const {
    return std::min(share_of_mode * report_.fit.axis.elasticity.resonance_Hz,
                    0.4 / report_.data.period_s);
  }

  [[nodiscard]] BothFits fit(double share_of_mode) const {
    auto input = input_;
    input.cutoff_Hz = cutoff_Hz(share_of_mode);
    const auto axis = report_.context.axis;
    return {identify::fit_ordinary_least_squares(report_.data, axis, input),
            identify::fit_ordinary_least_squares(report_.data, axis, input, &reference_)};
  }

 private:
  const TwoMassReport& report_;
  identify::OlsInput input_;
  std::vector<double> reference_;
};

double mean_of(const std::vector<double>& friction) {
  double mean = 0;
  for (const double each : friction) {
    mean += each / static_cast<double>(friction.size());
  }
  return mean;
}

std::string off(double found, double value) {
  return fmt::format("{:+.1f}", 100 * (found / value - 1));
}

ResultTable comparison(const TwoMassReport& report, const BothFits& both, double cutoff_Hz) {
  const auto& fit = report.fit;
  ResultTable table{
      .title = fmt::format("Ordinary least squares (4.9), filtered at {:.1f} Hz, and output error",
                           cutoff_Hz),
      .head = {"", "OLS", "output error", "OLS off by, %", "of which the method's bias, %"}};
  const auto row = [&](const char* name, double found, double value, double on_reference) {
    table.rows.push_back({name, fmt::format("{:.4g}", found), fmt::format("{:.4g}", value),
                          off(found, value), off(on_reference, value)});
  };
  const auto& ols = both.of_machine;
  const auto& known = both.of_reference;
  row("J, kg m2", ols.inertia_kg_m2, fit.axis.inertia_kg_m2, known.inertia_kg_m2);
  row("B, N m s/rad", ols.viscous_Nm_s_per_rad, fit.axis.viscous_friction_Nm_s_per_rad,
      known.viscous_Nm_s_per_rad);
  row("C, mean of the map, N m", ols.coulomb_Nm, mean_of(fit.coulomb_Nm), known.coulomb_Nm);
  return table;
}

ResultTable by_cutoff(const TwoMassReport& report, const LeastSquares& squares) {
  const auto& fit = report.fit;
  ResultTable table{
      .title = fmt::format("OLS by the filter's cut-off; the transmission's mode is {:.1f} "
                           "Hz",
                           fit.axis.elasticity.resonance_Hz),
      .head = {"cut-off, Hz", "share of the mode", "J off by, %", "B off by, %", "C off by, %",
               "residual, N m"}};
  for (const double share : kSharesOfTheMode) {
    const auto ols = squares.fit(share).of_machine;
    table.rows.push_back(
        {fmt::format("{:.1f}", squares.cutoff_Hz(share)), fmt::format("{:.2f}", share),
         off(ols.inertia_kg_m2, fit.axis.inertia_kg_m2),
         off(ols.viscous_Nm_s_per_rad, fit.axis.viscous_friction_Nm_s_per_rad),
         off(ols.coulomb_Nm, mean_of(fit.coulomb_Nm)), fmt::format("{:.2g}", ols.residual_rms_Nm)});
  }
  return table;
}

}  // namespace

void report_least_squares(const TwoMassReport& report, ProcedureOutcome& outcome) {
  const LeastSquares squares(report);
  const auto judged = squares.fit(kBelowTheMode);
  outcome.tables.push_back(comparison(report, judged, squares.cutoff_Hz(kBelowTheMode)));
  outcome.tables.push_back(by_cutoff(report, squares));
  ResultTable criteria{.title = "Criteria: " + report.input,
                       .head = {"criterion", "demand", "measured", "met"}};
  for (const auto& each : judged.of_machine.criteria) {
    criteria.rows.push_back({each.name, each.demand, each.measured, each.met ? "yes" : "NO"});
  }
  outcome.tables.push_back(std::move(criteria));
}

}  // namespace towbench::study::procedures
