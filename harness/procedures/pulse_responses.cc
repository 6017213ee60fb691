// EXP-OL-2: square-wave pulses. Ordinary least squares as the thesis has it, its bias shown by the
// same on a twin whose parameters are known; beside it output error, which has none.
#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "harness/identify/ordinary_least_squares.h"
#include "harness/identify/output_error.h"
#include "harness/procedures/believed_model.h"
#include "harness/procedures/procedures.h"
#include "harness/procedures/pulse_plan.h"
#include "harness/procedures/settings.h"

namespace towbench::harness::procedures {
namespace {

using identify::Estimate;

struct Settings {
  PulseWish wish;
  double start_share = 0.15;
  double knot_spacing_m = 0.3;
  int places = 5;
  double cutoff_Hz = 20;

  template <typename Visitor>
  void visit(Visitor& v) {
    v.value("on_s", wish.on_s, core::between(0.02, 1), "length of a pulse");
    v.value("off_s", wish.off_s, core::between(0.02, 1), "pause after it");
    v.value("peak_share", wish.peak_share, core::between(0.1, 0.79),
            "peak speed over the saturation speed; OLS-C-6 demands below 0.8");
    v.value("longest_m", wish.longest_m, core::above(0.0), "way that the pulses may take");
    v.value("most_pulses", wish.most_pulses, core::between(2, 200), "in one direction");
    v.value("start_share", start_share, core::between(0.05, 0.6), "of the track, where it starts");
    v.value("knot_spacing_m", knot_spacing_m, core::between(0.01, 2), "of the friction's map");
    v.value("places", places, core::between(1, 20), "along the axis at which pulses are given");
    v.value("cutoff_hz", cutoff_Hz, core::between(1, 200), "of the filter before least squares");
  }
};

// What quantisation leaves is 1/sqrt(12) of a count (a right model was seen to leave 0.285). A fit
// that leaves more has bent its parameters round something that it does not know, and its
// intervals, which suppose the model, say nothing.
constexpr double kMostLeft_counts = 2;

class PulseResponses final : public Procedure {
 public:
  [[nodiscard]] std::string_view id() const noexcept override { return "EXP-OL-2"; }
  [[nodiscard]] std::string_view title() const noexcept override { return "Pulse responses"; }

  [[nodiscard]] ProcedureOutcome run(const ProcedureContext& context) const override {
    const auto settings = read_settings<Settings>(context.settings, context.axis);
    const auto track = track_of(context.machine.configuration().axes[context.axis]);
    const double start_m = track.min_m + settings.start_share * track.length_m();
    const auto plan = plan_pulses(context, settings.wish, start_m);
    if (!plan.refusal.empty()) {
      return ProcedureOutcome::refused(plan.refusal);
    }
    const auto data = play(context, settings, plan, start_m);
    if (!data.trouble.empty()) {
      return ProcedureOutcome::failed(data.trouble);
    }
    context.tell(0.2);
    identify::TwoMassStart start{.axis = believed_axis(context), .path = believed_path(context)};
    start.knots_m = knots_of(data, context.axis, settings.knot_spacing_m);
    start.stribeck_known = 0.7;
    start.excess_known = 0.5;
    const auto fit = identify::fit_two_mass(start, data, context.axis);
    if (!fit.converged || fit.simulated_counts.empty()) {
      return ProcedureOutcome::failed("output error did not converge: " + fit.message);
    }
    if (fit.residual_rms_counts > kMostLeft_counts) {
      return ProcedureOutcome::failed(fmt::format(
          "the two-mass model does not explain the pulses: {:.1f} counts RMS are left, a right one "
          "leaves the encoder's own 0.29; try a finer knot_spacing_m",
          fit.residual_rms_counts));
    }
    ProcedureOutcome outcome;
    add_estimates(context, fit, start.knots_m, data, outcome);
    add_ols(context, settings, plan, fit, data, outcome);
    add_figures(context, fit, data, outcome);
    return outcome;
  }

 private:
  static identify::Recording play(const ProcedureContext& context, const Settings& settings,
                                  const PulsePlan& plan, double start_m) {
    Conversation talk{.name = fmt::format("EXP-OL-2-{}", core::name_of(context.axis))};
    talk.start_m = middle_of_tracks(context.machine);
    talk.start_m[context.axis] = start_m;
    talk.steps = declare_position(talk, context.machine);
    // Sets of pulses along the axis, one way and the other so that they do not wander off.
    const auto& belief = context.machine.configuration().axes[context.axis];
    const auto track = track_of(belief);
    const double span_m =
        std::min(settings.wish.longest_m, track.max_m - start_m - 1.3 * plan.reach_m);
    const double apart_m =
        settings.places > 1 ? std::max(0.0, span_m) / (settings.places - 1) : 0.0;
    for (int place = 0; place < settings.places; ++place) {
      for (const char direction : {'+', '-'}) {
        talk.steps.push_back(move(fmt::format(
            "rmpi si {} --duty {}% --on {}s --off {}s --pulses {} --alternate -d {} --rest 2s",
            core::name_of(context.axis), plan.duty_pct, settings.wish.on_s, settings.wish.off_s,
            plan.pulses, direction)));
      }
      if (place + 1 < settings.places && apart_m > 1e-3) {
        talk.steps.push_back(move(fmt::format("run -trapez {} --distance {:.4f}m --speed {:.3f}m/s",
                                              core::name_of(context.axis), apart_m,
                                              0.4 * belief.speed_limit_m_per_s)));
      }
    }
    talk.limit_s = 300;
    return context.machine.play(talk, studied_configuration(context));
  }

  static std::vector<double> knots_of(const identify::Recording& data, core::Axis axis,
                                      double spacing_m) {
    const auto& counts = data.axes[axis].count;
    const auto [low, high] = std::minmax_element(counts.begin(), counts.end());
    const double from = static_cast<double>(*low) * data.metres_per_count[axis];
    const double to = static_cast<double>(*high) * data.metres_per_count[axis];
    const int pieces = std::clamp(static_cast<int>(std::lround((to - from) / spacing_m)), 1, 12);
    std::vector<double> knots;
    for (int i = 0; i <= pieces; ++i) {
      knots.push_back(from + (to - from) * i / pieces);
    }
    return knots;
  }

  static void add_estimates(const ProcedureContext& context, const identify::TwoMassFit& fit,
                            const std::vector<double>& knots, const identify::Recording& data,
                            ProcedureOutcome& outcome) {
    const auto scale = torque_scale(context);
    const auto rests = fmt::format(
        "output error of the two-mass model over {} rows, residual {:.2f} counts; torque by {}",
        data.rows(), fit.residual_rms_counts,
        scale.measured ? "EXP-P-1" : "the believed K_T K_amp, whose error is not in the interval");
    const auto add = [&](const char* quantity, double value, double deviation, const char* unit,
                         bool scales) {
      // The simulation is exact to about one part in a thousand of what it leaves out.
      const double whole = std::hypot(
          deviation, value * std::hypot(kModelError, scales ? scale.relative_deviation : 0.0));
      outcome.estimates.push_back(
          identify::with_deviation({.quantity = quantity,
                                    .axis = std::string(core::name_of(context.axis)),
                                    .value = value,
                                    .unit = unit,
                                    .rests_on = rests,
                                    .procedure = "EXP-OL-2"},
                                   whole));
    };
    add("inertia_kg_m2", fit.axis.inertia_kg_m2, fit.inertia_deviation, "kg m2", true);
    add("viscous_friction_Nm_s_per_rad", fit.axis.viscous_friction_Nm_s_per_rad,
        fit.viscous_deviation, "N m s/rad", true);
    add("chain_resonance_Hz", fit.axis.chain.resonance_Hz, fit.resonance_deviation_Hz, "Hz", false);
    add("chain_damping_ratio", fit.axis.chain.damping_ratio, fit.damping_deviation, "1", false);
    add("friction_common_Nm", fit.axis.coulomb_friction_Nm, fit.common_deviation_Nm, "N m", true);
    add("friction_carriage_share", fit.axis.friction.carriage_share, fit.share_deviation, "1",
        false);
    add("stribeck_speed_rad_per_s", fit.axis.friction.stribeck_speed_rad_per_s,
        fit.stribeck_deviation, "rad/s", false);
    add("stiction_excess_Nm", fit.excess_Nm, fit.excess_deviation_Nm, "N m", true);
    for (std::size_t i = 0; i < knots.size(); ++i) {
      // Between knots the map may bend where no knot is.
      double bend = 0;
      if (i > 0 && i + 1 < knots.size()) {
        bend = std::fabs(fit.coulomb_Nm[i - 1] - 2 * fit.coulomb_Nm[i] + fit.coulomb_Nm[i + 1]) / 8;
      }
      add("coulomb_friction_Nm", fit.coulomb_Nm[i], std::hypot(fit.coulomb_deviation_Nm[i], bend),
          "N m", true);
      outcome.estimates.back().at = knots[i];
    }
  }

  static void add_ols(const ProcedureContext& context, const Settings& settings,
                      const PulsePlan& plan, const identify::TwoMassFit& fit,
                      const identify::Recording& data, ProcedureOutcome& outcome) {
    const auto& belief = context.machine.configuration().axes[context.axis];
    const identify::OlsInput input{
        .torque_per_duty_Nm = torque_scale(context).torque_per_duty_Nm,
        .cutoff_Hz = settings.cutoff_Hz,
        .saturation_speed_m_per_s =
            value_or(context, "saturation_speed_m_per_s", belief.speed_limit_m_per_s),
        .largest_duty_pct = 100 * belief.drive.current_limit_A /
                            (belief.drive.amplifier_gain_A_per_V * belief.drive.pwm_amplitude_V)};
    const auto ols = identify::fit_ordinary_least_squares(data, context.axis, input);
    // The same processing of a machine whose parameters are known: what it adds is its bias.
    std::vector<double> twin(fit.simulated_counts.size());
    std::transform(fit.simulated_counts.begin(), fit.simulated_counts.end(), twin.begin(),
                   [](double count) { return std::floor(count); });
    const auto of_twin = identify::fit_ordinary_least_squares(data, context.axis, input, &twin);
    double mean_friction = 0;
    for (const double each : fit.coulomb_Nm) {
      mean_friction += each / static_cast<double>(fit.coulomb_Nm.size());
    }
    ResultTable table{
        .title = "Ordinary least squares (4.9) and output error",
        .head = {"", "OLS", "output error", "OLS off by, %", "of which the method's bias, %"}};
    const auto row = [&](const char* name, double biased, double value, double on_twin) {
      table.rows.push_back({name, fmt::format("{:.4g}", biased), fmt::format("{:.4g}", value),
                            fmt::format("{:+.1f}", 100 * (biased / value - 1)),
                            fmt::format("{:+.1f}", 100 * (on_twin / value - 1))});
    };
    row("J, kg m2", ols.inertia_kg_m2, fit.axis.inertia_kg_m2, of_twin.inertia_kg_m2);
    row("B, N m s/rad", ols.viscous_Nm_s_per_rad, fit.axis.viscous_friction_Nm_s_per_rad,
        of_twin.viscous_Nm_s_per_rad);
    row("C, mean of the map, N m", ols.coulomb_Nm, mean_friction, of_twin.coulomb_Nm);
    outcome.tables.push_back(std::move(table));
    ResultTable criteria{.title = fmt::format("Criteria at {} % duty, {} pulses each way",
                                              plan.duty_pct, plan.pulses),
                         .head = {"criterion", "demand", "measured", "met"}};
    for (const auto& each : ols.criteria) {
      criteria.rows.push_back({each.name, each.demand, each.measured, each.met ? "yes" : "NO"});
    }
    outcome.tables.push_back(std::move(criteria));
  }

  static void add_figures(const ProcedureContext& context, const identify::TwoMassFit& fit,
                          const identify::Recording& data, ProcedureOutcome& outcome) {
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
    outcome.figures.push_back(
        {.title = "What the model leaves, from one end of the run to the other",
         .x_label = "time, s",
         .y_label = "position, mm",
         .curves = {std::move(residual)}});
  }

  static constexpr double kModelError = 1e-3;
};

}  // namespace

std::unique_ptr<Procedure> pulse_responses() {
  return std::make_unique<PulseResponses>();
}

}  // namespace towbench::harness::procedures
