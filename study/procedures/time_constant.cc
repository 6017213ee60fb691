// EXP-P-2: mechanical time constant J/B (thesis 4.1.2), coarse: from coasting after a push.
//
// Friction that grows along the way bends a coast one way round going there and the other way round
// coming back, so coasts are made in pairs over the same stretch and each pair gives one value.
#include <algorithm>
#include <cmath>

#include <boost/math/distributions/students_t.hpp>
#include <fmt/format.h>

#include "study/identify/coast.h"
#include "study/procedures/believed_model.h"
#include "study/procedures/procedures.h"
#include "study/procedures/settings.h"
#include "study/statistics/statistics.h"

namespace towbench::study::procedures {
namespace {

struct TimeConstantSettings {
  double speed_share = 0.6;
  double duty_pct = 30;
  int pairs = 4;

  template <typename Visitor>
  void visit(Visitor& v) {
    v.value("speed_share", speed_share, core::between(0.1, 0.9),
            "of the believed speed limit at which the drive lets go");
    v.value("duty_pct", duty_pct, core::between(1, 100), "of the push");
    v.value("pairs", pairs, core::between(3, 20), "of coasts, along the track");
  }
};

class TimeConstant final : public Procedure {
 public:
  [[nodiscard]] std::string_view id() const noexcept override { return "EXP-P-2"; }
  [[nodiscard]] std::string_view title() const noexcept override {
    return "Mechanical time constant";
  }
  void check_settings(const std::filesystem::path& file) const override {
    static_cast<void>(read_settings<TimeConstantSettings>(file, core::Axis::kY));
  }

  [[nodiscard]] ProcedureOutcome run(const ProcedureContext& context) const override {
    const auto settings = read_settings<TimeConstantSettings>(context.settings, context.axis);
    const auto& belief = context.machine.configuration().axes[context.axis];
    const auto axis = believed_axis(context);
    const double torque_Nm = settings.duty_pct * torque_scale(context).torque_per_duty_Nm;
    const double worst_Nm = belief.plausibility.worst_breakaway_Nm;
    if (torque_Nm < 1.5 * worst_Nm) {
      return ProcedureOutcome::refused(
          fmt::format("stall: {} % duty is {:.2g} N m, break-away may take {:.2g} N m",
                      settings.duty_pct, torque_Nm, worst_Nm));
    }
    const double radius = context.machine.nameplate(context.axis).metres_per_motor_rad();
    const double speed = settings.speed_share * belief.speed_limit_m_per_s;
    const double push_s = axis.inertia_kg_m2 * speed / radius / (torque_Nm - worst_Nm);
    // Half as fast again as meant, down to rest against the least friction believed.
    const double coast_m =
        1.5 * 1.5 * speed * speed * axis.inertia_kg_m2 / (2 * axis.coulomb_friction_Nm * radius);
    const double way_m = coast_m + 1.5 * speed * push_s;
    const auto track = track_of(belief);
    if (way_m > 0.8 * track.length_m()) {
      return ProcedureOutcome::refused(
          fmt::format("no travel: a coast may take {:.2f} m of {:.2f} m", way_m, track.length_m()));
    }
    std::vector<double> constants;
    std::vector<double> swings_Hz;
    ResultTable table{.title = "Coasts, in pairs",
                      .head = {"from, m", "J/B, s", "swing, Hz", "left, counts"}};
    Figure figure;
    for (int i = 0; i < settings.pairs; ++i) {
      const double share = (i + 0.5) / settings.pairs;
      const double start_m =
          track.min_m + 0.1 * track.length_m() + share * (0.85 * track.length_m() - way_m);
      const auto data = play(context, settings, push_s, start_m, i);
      if (!data.trouble.empty()) {
        return ProcedureOutcome::failed(data.trouble);
      }
      const auto spans =
          identify::find_coasts(data, context.axis, {.fastest_m_per_s = fastest_coast(context)});
      const auto fit = identify::fit_coasts(data, context.axis, spans,
                                            axis.inertia_kg_m2 / axis.viscous_friction_Nm_s_per_rad,
                                            axis.elasticity.resonance_Hz);
      if (spans.size() < 2 || !fit.converged) {
        return ProcedureOutcome::failed(
            fmt::format("{} coasts from {:.2f} m gave no time constant", spans.size(), start_m));
      }
      constants.push_back(fit.time_constant_s);
      swings_Hz.push_back(fit.swing_Hz);
      table.rows.push_back(
          {fmt::format("{:.2f}", start_m), fmt::format("{:.3f}", fit.time_constant_s),
           fmt::format("{:.2f}", fit.swing_Hz), fmt::format("{:.2f}", fit.residual_rms_counts)});
      if (i == 0) {
        figure = speed_figure(data, context.axis, "Pushes and coasts");
      }
      context.tell(static_cast<double>(i + 1) / settings.pairs);
    }
    return judged(context, constants, swings_Hz, std::move(table), std::move(figure));
  }

 private:
  // Nine tenths of the speed whose back EMF the amplifier can just stand against.
  static double fastest_coast(const ProcedureContext& context) {
    constexpr double kShare = 0.9;
    const auto& plate = context.machine.nameplate(context.axis);
    return kShare * plate.output_limit_V / believed_axis(context).torque_constant_Nm_per_A *
           plate.metres_per_motor_rad();
  }

  static identify::Recording play(const ProcedureContext& context,
                                  const TimeConstantSettings& settings, double push_s,
                                  double start_m, int number) {
    Conversation talk{.name = fmt::format("EXP-P-2-{}-{}", core::name_of(context.axis), number)};
    talk.start_m = middle_of_tracks(context.machine);
    talk.start_m[context.axis] = start_m;
    talk.steps = declare_position(talk, context.machine);
    for (const char direction : {'+', '-'}) {
      talk.steps.push_back(
          move(fmt::format("rmpi step {} --duty {}% -d {} --time {:.3f}s --wait 0.2s --rest 4s",
                           core::name_of(context.axis), settings.duty_pct, direction, push_s)));
    }
    talk.limit_s = 60;
    return context.machine.play(talk, studied_configuration(context));
  }

  static ProcedureOutcome judged(const ProcedureContext& context,
                                 const std::vector<double>& constants,
                                 std::vector<double> swings_Hz, ResultTable table, Figure figure) {
    const auto n = static_cast<double>(constants.size());
    double mean = 0;
    for (const double each : constants) {
      mean += each / n;
    }
    double square = 0;
    for (const double each : constants) {
      square += (each - mean) * (each - mean) / (n - 1);
    }
    const double spread =
        boost::math::quantile(boost::math::students_t(n - 1), 0.975) * std::sqrt(square / n);
    // A loss that grows with the load, which EXP-P-1 has seen, bends a coast as well.
    const double half =
        std::hypot(spread, kModelError95 * mean,
                   statistics::kNormal95 * torque_scale(context).relative_standard_error * mean);
    ProcedureOutcome outcome;
    outcome.estimates.push_back(
        {.quantity = "mechanical_time_constant_s",
         .axis = std::string(core::name_of(context.axis)),
         .value = mean,
         .low = mean - half,
         .high = mean + half,
         .unit = "s",
         .rests_on = fmt::format("{} pairs of coasts, there and back; encoder alone, no drive "
                                 "constant",
                                 constants.size()),
         .procedure = "EXP-P-2"});
    // A first guess of the transmission's mode for what comes after: the middle one, as wide as
    // they lie.
    std::sort(swings_Hz.begin(), swings_Hz.end());
    outcome.estimates.push_back({.quantity = "swing_Hz",
                                 .axis = std::string(core::name_of(context.axis)),
                                 .value = swings_Hz[swings_Hz.size() / 2],
                                 .low = swings_Hz.front(),
                                 .high = swings_Hz.back(),
                                 .unit = "Hz",
                                 .rests_on = "the swing on top of the same coasts; least and most",
                                 .procedure = "EXP-P-2"});
    outcome.tables.push_back(std::move(table));
    outcome.figures.push_back(std::move(figure));
    return outcome;
  }

  // One rigid body, one swing: what friction bends and the current's decay leave open, *assumed*.
  static constexpr double kModelError95 = 0.02;
};

}  // namespace

std::unique_ptr<Procedure> time_constant() {
  return std::make_unique<TimeConstant>();
}

}  // namespace towbench::study::procedures
