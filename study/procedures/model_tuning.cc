// Model-based tuning: gains by pole placement on the model that EXP-OL-2 has found, once as stiff
// as the sensitivity allows and once with the transmission damped, tried on the same trapezoids as
// the gains of Table 4.1, of Table 7.2 and the controller's own.
#include <algorithm>
#include <cmath>
#include <string_view>
#include <utility>

#include <fmt/format.h>

#include "core/bounded_vector.h"
#include "study/identify/pole_placement.h"
#include "study/procedures/believed_model.h"
#include "study/procedures/procedures.h"
#include "study/procedures/settings.h"

namespace towbench::study::procedures {
namespace {

struct ModelTuningSettings {
  double damping_ratio = 0.7;
  double largest_sensitivity = 2.0;
  core::BoundedVector<double, 8> speeds_m_per_s;
  double distance_m = 0.2;

  ModelTuningSettings() noexcept {
    for (const double each : {0.03, 0.1, 0.25}) {
      (void)speeds_m_per_s.push_back(each);
    }
  }

  template <typename Visitor>
  void visit(Visitor& v) {
    v.value("damping_ratio", damping_ratio, core::between(0.3, 1.0), "of the placed pair of poles");
    v.value("largest_sensitivity", largest_sensitivity, core::between(1.1, 4.0),
            "M_s that the loop may have");
    v.list("speeds_m_per_s", speeds_m_per_s, core::between(0.005, 0.35), "of the trials");
    v.value("distance_m", distance_m, core::between(0.05, 0.5), "of the trials");
  }
};

// Gains by a name, and what was found with them.
struct GainSet {
  std::string name;
  identify::LoopGains gains;
  std::string design;  // of the placed ones: frequency, sensitivity, damping
};

struct Trial {
  std::string trouble;
  double rms_m = 0;  // of the motor's error while the reference moves
  double peak_m = 0;
};

Trial trial_of(const identify::Recording& run, core::Axis which) {
  Trial trial{.trouble = run.trouble};
  const auto& axis = run.axes[which];
  double rows = 0;
  for (std::size_t k = 0; k < run.rows(); ++k) {
    if (axis.reference_velocity_m_per_s[k] != 0) {
      const double error = axis.reference_m[k] - run.position_m(which, k);
      trial.rms_m += error * error;
      trial.peak_m = std::max(trial.peak_m, std::fabs(error));
      rows += 1;
    }
  }
  if (rows == 0 && trial.trouble.empty()) {
    trial.trouble = "not driven";
  }
  trial.rms_m = rows > 0 ? std::sqrt(trial.rms_m / rows) : 0;
  return trial;
}

Trial try_gains(const ProcedureContext& context, const ModelTuningSettings& settings,
                const identify::LoopGains& gains, double speed_m_per_s) {
  const auto axis = core::name_of(context.axis);
  Conversation talk{.name = fmt::format("pole-placement-{}-{}", axis, speed_m_per_s)};
  talk.start_m = middle_of_tracks(context.machine);
  talk.steps = declare_position(talk, context.machine);
  talk.steps.push_back(say(fmt::format(
      "config gains {} --kp {:.9f}Nm/rad --ki {:.9f}Nm/(rad*s) --kd {:.9f}Nm*s/rad", axis,
      gains.proportional_Nm_per_rad, gains.integral_Nm_per_rad_s, gains.derivative_Nm_s_per_rad)));
  for (const double sign : {1.0, -1.0}) {
    talk.steps.push_back(move(fmt::format("run -trapez {} --distance {}m --speed {}m/s", axis,
                                          sign * settings.distance_m, speed_m_per_s)));
  }
  talk.limit_s = 240;
  return trial_of(context.machine.play(talk, studied_configuration(context)), context.axis);
}

identify::TwoMassAxis model_of(const ProcedureContext& context) {
  const auto axis = believed_axis(context);
  return {
      .inertia_kg_m2 = axis.inertia_kg_m2,
      .rotor_inertia_kg_m2 = value_or(context, "rotor_inertia_kg_m2", axis.rotor_inertia_kg_m2),
      .viscous_Nm_s_per_rad = axis.viscous_friction_Nm_s_per_rad,
      .resonance_Hz = value_or(context, "transmission_resonance_Hz", axis.elasticity.resonance_Hz),
      .damping_ratio =
          value_or(context, "transmission_damping_ratio", axis.elasticity.damping_ratio)};
}

std::vector<GainSet> placed(const ProcedureContext& context, const ModelTuningSettings& settings) {
  const identify::SampledLoop loop{.period_s = 1 / context.machine.configuration().control_rate_Hz};
  std::vector<GainSet> sets;
  for (const bool damped : {false, true}) {
    const auto found = identify::fastest_loop(model_of(context), loop,
                                              {.damping_ratio = settings.damping_ratio,
                                               .largest_sensitivity = settings.largest_sensitivity,
                                               .dominant = damped});
    if (found) {
      sets.push_back({damped ? "poles placed, transmission damped" : "poles placed, stiff",
                      found->gains,
                      fmt::format("w_0 {:.0f} rad/s, M_s {:.2f}, slowest decay {:.2g} 1/s",
                                  found->frequency_rad_per_s, found->largest_sensitivity,
                                  found->slowest_decay_per_s)});
    }
  }
  return sets;
}

// Table 4.1 with its errata, of the relay's amplitude that is nearest to 0.5 mm.
void add_ziegler_nichols(const ProcedureContext& context, std::vector<GainSet>& sets) {
  constexpr double kAmplitude_m = 5e-4;
  const auto of = [&](std::string_view quantity) {
    const identify::Estimate* nearest = nullptr;
    for (const auto& each : context.known) {
      if (each.quantity == quantity && each.axis == core::name_of(context.axis) && each.at &&
          (nearest == nullptr ||
           std::fabs(*each.at - kAmplitude_m) < std::fabs(*nearest->at - kAmplitude_m))) {
        nearest = &each;
      }
    }
    return nearest;
  };
  const auto* gain = of("critical_gain_Nm_per_rad");
  const auto* period = of("critical_period_s");
  if (gain == nullptr || period == nullptr) {
    return;
  }
  const double proportional = 0.6 * gain->value;
  sets.push_back(
      {"Ziegler-Nichols, Table 4.1",
       {proportional, proportional / (period->value / 2), proportional * period->value / 8},
       fmt::format("K_C at {:.2f} mm", 1e3 * *gain->at)});
}

std::vector<GainSet> beside(const ProcedureContext& context) {
  std::vector<GainSet> sets;
  add_ziegler_nichols(context, sets);
  const auto& axis = context.machine.configuration().axes[context.axis];
  if (context.axis == core::Axis::kY) {
    // Per count and per sample of 1 ms: docs/reference/constants.md, errata.
    const double rad = axis.rad_per_count();
    sets.push_back({"Table 7.2", {1.32e-6 / rad, 3.29e-10 / 1e-3 / rad, 1.32e-7 / rad}, ""});
  }
  sets.push_back({"the controller's own",
                  {axis.gains.proportional_Nm_per_rad, axis.gains.integral_Nm_per_rad_s,
                   axis.gains.derivative_Nm_s_per_rad},
                  ""});
  return sets;
}

std::string cell(const Trial& trial) {
  return trial.trouble.empty()
             ? fmt::format("{:.1f} / {:.0f}", 1e6 * trial.rms_m, 1e6 * trial.peak_m)
             : trial.trouble;
}

class ModelTuning final : public Procedure {
 public:
  [[nodiscard]] std::string_view id() const noexcept override { return "pole-placement"; }
  [[nodiscard]] std::string_view title() const noexcept override {
    return "Pole placement from the identified model";
  }
  void check_settings(const std::filesystem::path& file) const override {
    static_cast<void>(read_settings<ModelTuningSettings>(file, core::Axis::kY));
  }

  [[nodiscard]] ProcedureOutcome run(const ProcedureContext& context) const override {
    const auto settings = read_settings<ModelTuningSettings>(context.settings, context.axis);
    const auto track = track_of(context.machine.configuration().axes[context.axis]);
    if (2 * settings.distance_m > track.length_m()) {
      return ProcedureOutcome::refused(fmt::format("no travel: a trial takes {:.2f} m of {:.2f} m",
                                                   settings.distance_m, track.length_m()));
    }
    auto sets = placed(context, settings);
    const std::size_t own = sets.size();
    if (own == 0) {
      return ProcedureOutcome::failed(
          fmt::format("no gains place a pair of damping {:.2f} within M_s = {:.2f} on this model",
                      settings.damping_ratio, settings.largest_sensitivity));
    }
    for (auto& each : beside(context)) {
      sets.push_back(std::move(each));
    }
    return tried(context, settings, sets, own);
  }

 private:
  // `own` of the sets are placed: one of them at least must drive the axis at every speed.
  static ProcedureOutcome tried(const ProcedureContext& context,
                                const ModelTuningSettings& settings,
                                const std::vector<GainSet>& sets, std::size_t own) {
    ResultTable table{
        .title =
            "Gains by the model, by Table 4.1 and by the thesis on the same trapezoids; error "
            "of the motor, RMS / peak in um",
        .head = {"gains", "K_P, N m/rad", "K_I, N m/(rad s)", "K_D, N m s/rad", "design"}};
    for (const double speed : settings.speeds_m_per_s) {
      table.head.push_back(fmt::format("{:.0f} mm/s", 1e3 * speed));
    }
    std::string trouble;
    std::size_t sound = 0;
    for (std::size_t k = 0; k < sets.size(); ++k) {
      const auto& [name, gains, design] = sets[k];
      std::vector<std::string> row{name, fmt::format("{:.3g}", gains.proportional_Nm_per_rad),
                                   fmt::format("{:.3g}", gains.integral_Nm_per_rad_s),
                                   fmt::format("{:.3g}", gains.derivative_Nm_s_per_rad), design};
      bool all = true;
      for (const double speed : settings.speeds_m_per_s) {
        const auto trial = try_gains(context, settings, gains, speed);
        row.push_back(cell(trial));
        all = all && trial.trouble.empty();
        trouble = trial.trouble.empty() ? trouble : name + ": " + trial.trouble;
      }
      sound += all && k < own ? 1 : 0;
      table.rows.push_back(std::move(row));
      context.tell(static_cast<double>(k + 1) / static_cast<double>(sets.size()));
    }
    if (sound == 0) {
      return ProcedureOutcome::failed("the loop with placed poles: " + trouble);
    }
    ProcedureOutcome outcome;
    outcome.tables.push_back(std::move(table));
    return outcome;
  }
};

}  // namespace

std::unique_ptr<Procedure> model_tuning() {
  return std::make_unique<ModelTuning>();
}

}  // namespace towbench::study::procedures
