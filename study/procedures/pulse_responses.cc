// EXP-OL-2: square-wave pulses. Ordinary least squares (7.2.1); its bias is measured on a simulated
// reference whose parameters are known. The output-error fit beside it is unbiased.
#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "study/identify/output_error.h"
#include "study/procedures/believed_model.h"
#include "study/procedures/procedures.h"
#include "study/procedures/pulse_plan.h"
#include "study/procedures/pulse_start.h"
#include "study/procedures/settings.h"
#include "study/procedures/two_mass_report.h"

namespace towbench::study::procedures {
namespace {

struct PulseResponsesSettings {
  PulseLimits limits;
  double start_share = 0.15;
  double knot_spacing_m = 0.3;
  int places = 5;

  template <typename Visitor>
  void visit(Visitor& v) {
    v.value("on_s", limits.on_s, core::between(0.02, 1), "length of a pulse");
    v.value("off_s", limits.off_s, core::between(0.02, 1), "pause after it");
    v.value("peak_share", limits.peak_share, core::between(0.1, 0.79),
            "peak speed over the saturation speed; OLS-C-6 demands below 0.8");
    v.value("longest_m", limits.longest_m, core::above(0.0), "way that the pulses may take");
    v.value("most_pulses", limits.most_pulses, core::between(2, 200), "in one direction");
    v.value("start_share", start_share, core::between(0.05, 0.6), "of the track, where it starts");
    v.value("knot_spacing_m", knot_spacing_m, core::between(0.01, 2), "of the friction's map");
    v.value("places", places, core::between(1, 20), "along the axis at which pulses are given");
  }
};

class PulseResponses final : public Procedure {
 public:
  [[nodiscard]] std::string_view id() const noexcept override { return "EXP-OL-2"; }
  [[nodiscard]] std::string_view title() const noexcept override { return "Pulse responses"; }
  void check_settings(const std::filesystem::path& file) const override {
    static_cast<void>(read_settings<PulseResponsesSettings>(file, core::Axis::kY));
  }

  [[nodiscard]] ProcedureOutcome run(const ProcedureContext& context) const override {
    const auto settings = read_settings<PulseResponsesSettings>(context.settings, context.axis);
    const auto track = track_of(context.machine.configuration().axes[context.axis]);
    const double start_m = track.min_m + settings.start_share * track.length_m();
    auto plan = plan_pulses(context, settings.limits, start_m);
    if (!plan.refusal.empty()) {
      return ProcedureOutcome::refused(plan.refusal);
    }
    const auto data = play_below_saturation(context, settings, plan, start_m);
    if (!data.trouble.empty()) {
      return ProcedureOutcome::failed(data.trouble);
    }
    context.tell(0.2);
    const auto start = pulse_start(context, data, settings.knot_spacing_m);
    const auto fit = identify::fit_two_mass(start, data, context.axis);
    if (const auto why = unexplained(fit); !why.empty()) {
      return ProcedureOutcome::failed("the two-mass model does not explain the pulses: " + why);
    }
    ProcedureOutcome outcome;
    report_two_mass(
        {.context = context,
         .data = data,
         .fit = fit,
         .knots_are_bends = !start.coulomb_Nm.empty(),
         .procedure = "EXP-OL-2",
         .input = fmt::format("{} % duty, {} pulses each way", plan.duty_pct, plan.pulses)},
        outcome);
    return outcome;
  }

 private:
  // The plan assumes a rigid axis. The motor of a two-mass axis swings about the planned speed, the
  // further the softer the transmission. Near the voltage limit the sag of the supply, which no
  // model here has, changes the response; the pulses are then repeated with less duty.
  static identify::Recording play_below_saturation(const ProcedureContext& context,
                                                   const PulseResponsesSettings& settings,
                                                   PulsePlan& plan, double start_m) {
    constexpr double kLargestShare = 0.8;  // of the saturation speed, at the motor (OLS-C-6)
    constexpr int kTrials = 4;
    const double limit =
        kLargestShare *
        value_or(context, "saturation_speed_m_per_s",
                 context.machine.configuration().axes[context.axis].speed_limit_m_per_s);
    auto data = play(context, settings, plan, start_m);
    for (int trial = 1; trial < kTrials && data.trouble.empty(); ++trial) {
      const double peak = peak_speed(data, context.axis);
      if (peak <= limit) {
        break;
      }
      plan.duty_pct = std::floor(10 * plan.duty_pct * limit / peak) / 10;
      data = play(context, settings, plan, start_m);
    }
    return data;
  }

  static double peak_speed(const identify::Recording& data, core::Axis axis) {
    constexpr double kSpan_s = 0.003;  // of a difference: a tenth of the shortest swing
    const auto span =
        std::max<std::size_t>(1, static_cast<std::size_t>(std::lround(kSpan_s / data.period_s)));
    double peak = 0;
    for (std::size_t k = span; k < data.rows(); ++k) {
      peak = std::max(peak, std::fabs(data.position_m(axis, k) - data.position_m(axis, k - span)) /
                                (data.time_s[k] - data.time_s[k - span]));
    }
    return peak;
  }

  static identify::Recording play(const ProcedureContext& context,
                                  const PulseResponsesSettings& settings, const PulsePlan& plan,
                                  double start_m) {
    Conversation conversation{.name = fmt::format("EXP-OL-2-{}", core::name_of(context.axis))};
    conversation.start_m = middle_of_tracks(context.machine);
    conversation.start_m[context.axis] = start_m;
    conversation.steps = declare_position(conversation, context.machine);
    // Sets of pulses along the axis, in both directions so that the axis ends where it began.
    const auto& belief = context.machine.configuration().axes[context.axis];
    const auto track = track_of(belief);
    const double span_m =
        std::min(settings.limits.longest_m, track.max_m - start_m - 1.3 * plan.reach_m);
    const double spacing_m =
        settings.places > 1 ? std::max(0.0, span_m) / (settings.places - 1) : 0.0;
    for (int place = 0; place < settings.places; ++place) {
      for (const char direction : {'+', '-'}) {
        conversation.steps.push_back(move(fmt::format(
            "rmpi si {} --duty {}% --on {}s --off {}s --pulses {} --alternate -d {} --rest 2s",
            core::name_of(context.axis), plan.duty_pct, settings.limits.on_s, settings.limits.off_s,
            plan.pulses, direction)));
      }
      if (place + 1 < settings.places && spacing_m > 1e-3) {
        conversation.steps.push_back(move(
            fmt::format("run -trapez {} --distance {:.4f}m --speed {:.3f}m/s",
                        core::name_of(context.axis), spacing_m, 0.4 * belief.speed_limit_m_per_s)));
      }
    }
    conversation.limit_s = 300;
    return context.machine.play(conversation, studied_configuration(context));
  }
};

}  // namespace

std::unique_ptr<Procedure> pulse_responses() {
  return std::make_unique<PulseResponses>();
}

}  // namespace towbench::study::procedures
