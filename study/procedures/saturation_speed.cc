// EXP-P-3: the speed at which the supply's voltage is used up.
//
// One long step of high duty; the speed rises until back EMF and the winding's drop leave the
// current loop nothing to drive with, and stays there. Read from the encoder alone; the voltage
// limit says what it should be, and both must agree.
#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "study/identify/plateau.h"
#include "study/procedures/believed_model.h"
#include "study/procedures/procedures.h"
#include "study/procedures/settings.h"

namespace towbench::study::procedures {
namespace {

struct SaturationSpeedSettings {
  double duty_pct = 30;
  double start_share = 0.15;   // of the track, from its min end
  double longest_share = 0.5;  // of the track that a step may take

  template <typename Visitor>
  void visit(Visitor& v) {
    v.value("duty_pct", duty_pct, core::between(1, 100), "of the step");
    v.value("start_share", start_share, core::between(0.05, 0.9), "of the track, where it starts");
    v.value("longest_share", longest_share, core::between(0.01, 0.8),
            "of the track that the step may take");
  }
};

class SaturationSpeed final : public Procedure {
 public:
  [[nodiscard]] std::string_view id() const noexcept override { return "EXP-P-3"; }
  [[nodiscard]] std::string_view title() const noexcept override { return "Saturation speed"; }
  void check_settings(const std::filesystem::path& file) const override {
    static_cast<void>(read_settings<SaturationSpeedSettings>(file, core::Axis::kY));
  }

  [[nodiscard]] ProcedureOutcome run(const ProcedureContext& context) const override {
    const auto settings = read_settings<SaturationSpeedSettings>(context.settings, context.axis);
    const auto& plate = context.machine.nameplate(context.axis);
    const auto& belief = context.machine.configuration().axes[context.axis];
    const double k =
        value_or(context, "torque_constant_Nm_per_A", belief.drive.torque_constant_Nm_per_A);
    const double gain =
        value_or(context, "amplifier_gain_A_per_V", belief.drive.amplifier_gain_A_per_V);
    // Speed at the voltage limit without load: no machine of these documents goes faster.
    const double limit_m_per_s = plate.output_limit_V / k * plate.metres_per_motor_rad();
    const double torque_Nm = settings.duty_pct / 100 * plate.pwm_amplitude_V * gain * k;
    const double worst_Nm = belief.plausibility.worst_breakaway_Nm;
    if (torque_Nm <= worst_Nm) {
      return ProcedureOutcome::refused(
          fmt::format("stall: {} % duty is {:.2g} N m, break-away may take {:.2g} N m",
                      settings.duty_pct, torque_Nm, worst_Nm));
    }
    const auto track = track_of(belief);
    // J v / (tau - S) to speed, then as long again.
    const double rise_s = belief.feed_forward.inertia_kg_m2 * limit_m_per_s /
                          plate.metres_per_motor_rad() / (torque_Nm - worst_Nm);
    const double way_m = settings.longest_share * track.length_m();
    const double time_s = std::min(way_m / limit_m_per_s, 60.0);
    if (time_s < 1.2 * rise_s) {
      return ProcedureOutcome::refused(
          fmt::format("no travel: {:.2f} m take {:.2f} s at {:.2f} m/s, reaching it takes {:.2f} s",
                      way_m, time_s, limit_m_per_s, rise_s));
    }
    const auto data = play(context, settings, track, time_s);
    if (!data.trouble.empty()) {
      return ProcedureOutcome::failed(data.trouble);
    }
    return judged(context, identify::find_plateaus(data, context.axis, settings.duty_pct),
                  limit_m_per_s, data);
  }

 private:
  static identify::Recording play(const ProcedureContext& context,
                                  const SaturationSpeedSettings& settings, const Track& track,
                                  double time_s) {
    Conversation talk{.name =
                          fmt::format("EXP-P-3-{}-{:.3f}", core::name_of(context.axis), time_s)};
    talk.start_m = middle_of_tracks(context.machine);
    talk.start_m[context.axis] = track.min_m + settings.start_share * track.length_m();
    talk.steps = declare_position(talk, context.machine);
    for (const char direction : {'+', '-'}) {
      talk.steps.push_back(
          move(fmt::format("rmpi step {} --duty {}% -d {} --time {:.3f}s --wait 0.2s --rest 0s",
                           core::name_of(context.axis), settings.duty_pct, direction, time_s)));
    }
    talk.limit_s = 2 * time_s + 20;
    return context.machine.play(talk, studied_configuration(context));
  }

  static ProcedureOutcome judged(const ProcedureContext& context,
                                 const std::vector<identify::Plateau>& plateaus,
                                 double limit_m_per_s, const identify::Recording& data) {
    if (plateaus.size() < 2) {
      return ProcedureOutcome::failed("the speed never came to a steady value in both directions");
    }
    double sum = 0;
    double place = 0;
    double worst = 0;
    for (const auto& each : plateaus) {
      sum += std::fabs(each.speed_m_per_s);
      place += each.middle_m;
      worst = std::max(worst, each.half_width_m_per_s);
    }
    const auto n = static_cast<double>(plateaus.size());
    const double speed = sum / n;
    double apart = 0;
    for (const auto& each : plateaus) {
      apart = std::max(apart, std::fabs(std::fabs(each.speed_m_per_s) - speed));
    }
    const double half = std::hypot(worst, apart);
    ProcedureOutcome outcome;
    outcome.estimates.push_back(
        {.quantity = "saturation_speed_m_per_s",
         .axis = std::string(core::name_of(context.axis)),
         .value = speed,
         .low = speed - half,
         .high = speed + half,
         .unit = "m/s",
         .rests_on = fmt::format("{} plateaus of the encoder's speed, around {:.2f} m; no model",
                                 plateaus.size(), place / n),
         .procedure = "EXP-P-3",
         .at = place / n});
    outcome.tables.push_back(
        {.title = "Saturation speed",
         .head = {"measured, m/s", "voltage limit without load, m/s", "used up by friction, %"},
         .rows = {{fmt::format("{:.4f} +- {:.4f}", speed, half),
                   fmt::format("{:.4f}", limit_m_per_s),
                   fmt::format("{:.1f}", 100 * (1 - speed / limit_m_per_s))}}});
    outcome.figures.push_back(speed_figure(data, context.axis, "Step to saturation"));
    return outcome;
  }
};

}  // namespace

std::unique_ptr<Procedure> saturation_speed() {
  return std::make_unique<SaturationSpeed>();
}

}  // namespace towbench::study::procedures
