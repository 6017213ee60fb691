// EXP-OL-2: square-wave pulses. Ordinary least squares (7.2.1), its bias shown by the
// same on a simulated reference whose parameters are known; beside it output error, which has none.
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

namespace towbench::harness::procedures {
namespace {

struct PulseResponsesSettings {
  PulseWish wish;
  double start_share = 0.15;
  double knot_spacing_m = 0.3;
  int places = 5;

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
    auto plan = plan_pulses(context, settings.wish, start_m);
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
  // The plan knows of one body; the motor of two swings on top of it, more so the slower the chain.
  // Where that takes it near the voltage limit the supply's sag has a say, which no model here
  // knows: the same with less duty.
  static identify::Recording play_below_saturation(const ProcedureContext& context,
                                                   const PulseResponsesSettings& settings,
                                                   PulsePlan& plan, double start_m) {
    constexpr double kMostOfSaturation = 0.8;  // OLS-C-6, of the motor itself
    constexpr int kMostTrials = 4;
    const double most =
        kMostOfSaturation *
        value_or(context, "saturation_speed_m_per_s",
                 context.machine.configuration().axes[context.axis].speed_limit_m_per_s);
    auto data = play(context, settings, plan, start_m);
    for (int trial = 1; trial < kMostTrials && data.trouble.empty(); ++trial) {
      const double peak = peak_speed(data, context.axis);
      if (peak <= most) {
        break;
      }
      plan.duty_pct = std::floor(10 * plan.duty_pct * most / peak) / 10;
      data = play(context, settings, plan, start_m);
    }
    return data;
  }

  static double peak_speed(const identify::Recording& data, core::Axis axis) {
    constexpr double kFew_s = 0.003;  // a tenth of the quickest swing
    const auto few =
        std::max<std::size_t>(1, static_cast<std::size_t>(std::lround(kFew_s / data.period_s)));
    double peak = 0;
    for (std::size_t k = few; k < data.rows(); ++k) {
      peak = std::max(peak, std::fabs(data.position_m(axis, k) - data.position_m(axis, k - few)) /
                                (data.time_s[k] - data.time_s[k - few]));
    }
    return peak;
  }

  static identify::Recording play(const ProcedureContext& context,
                                  const PulseResponsesSettings& settings, const PulsePlan& plan,
                                  double start_m) {
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
};

}  // namespace

std::unique_ptr<Procedure> pulse_responses() {
  return std::make_unique<PulseResponses>();
}

}  // namespace towbench::harness::procedures
