// Tuning (thesis 4.2.1): critical gain and period found by the controller's own relay at several
// amplitudes, gains from Table 4.1 with its errata, and the loop that they make tried on a
// trapezoid.
//
// Dry friction makes K_C depend on the amplitude, so it is shown as a curve and named with one.
#include <algorithm>
#include <charconv>
#include <cmath>
#include <optional>
#include <utility>

#include <fmt/format.h>

#include "core/bounded_vector.h"
#include "study/procedures/believed_model.h"
#include "study/procedures/procedures.h"
#include "study/procedures/settings.h"

namespace towbench::study::procedures {
namespace {

constexpr double kSmallest_m = 2e-4;  // 89 counts of Y: below, friction is all there is
constexpr double kSmaller = 0.8;

struct RelayTuningSettings {
  core::BoundedVector<double, 16> amplitudes_m;
  double chosen_m = 5e-4;
  double trial_speed_m_per_s = 0.1;
  double trial_distance_m = 0.2;

  RelayTuningSettings() noexcept {
    for (const double each : {3e-4, 4e-4, 5e-4, 6.5e-4, 8e-4}) {
      (void)amplitudes_m.push_back(each);
    }
  }

  template <typename Visitor>
  void visit(Visitor& v) {
    v.list("amplitudes_m", amplitudes_m, core::between(kSmallest_m, 1e-3),
           "of the relay's oscillation");
    v.value("chosen_m", chosen_m, core::between(kSmallest_m, 1e-3),
            "amplitude whose gains are tried");
    v.value("trial_speed_m_per_s", trial_speed_m_per_s, core::between(0.01, 0.5), "of the trial");
    v.value("trial_distance_m", trial_distance_m, core::between(0.02, 1), "of the trial");
  }
};

// The number that follows a word in what the console said, in the unit that it prints.
std::optional<double> number_after(std::string_view text, std::string_view word) {
  const auto at = text.rfind(word);
  if (at == std::string_view::npos) {
    return std::nullopt;
  }
  const auto rest = text.substr(at + word.size());
  double value = 0;
  const auto read = std::from_chars(rest.data(), rest.data() + rest.size(), value);
  return read.ec == std::errc{} ? std::optional(value) : std::nullopt;
}

struct Critical {
  double amplitude_m = 0;
  double gain_Nm_per_rad = 0;
  double period_s = 0;
  double relay_Nm = 0;
  std::string gains;  // " --kp ... --ki ... --kd ...", as the controller says and takes them
};

std::optional<Critical> critical_in(const std::string& console) {
  const auto gain = number_after(console, "K_C ");
  const auto period_ms = number_after(console, "T_C ");
  const auto amplitude_mm = number_after(console, "ms at ");
  const auto relay_mNm = number_after(console, "mm, relay ");
  const auto from = console.rfind(" --kp ");
  if (!gain || !period_ms || !amplitude_mm || !relay_mNm || from == std::string::npos) {
    return std::nullopt;
  }
  return Critical{1e-3 * *amplitude_mm, *gain, 1e-3 * *period_ms, 1e-3 * *relay_mNm,
                  console.substr(from, console.find_first_of("\r\n", from) - from)};
}

class RelayTuning final : public Procedure {
 public:
  [[nodiscard]] std::string_view id() const noexcept override { return "tuning"; }
  [[nodiscard]] std::string_view title() const noexcept override { return "Ziegler-Nichols"; }
  void check_settings(const std::filesystem::path& file) const override {
    static_cast<void>(read_settings<RelayTuningSettings>(file, core::Axis::kY));
  }

  [[nodiscard]] ProcedureOutcome run(const ProcedureContext& context) const override {
    const auto settings = read_settings<RelayTuningSettings>(context.settings, context.axis);
    const auto track = track_of(context.machine.configuration().axes[context.axis]);
    if (2 * settings.trial_distance_m > track.length_m()) {
      return ProcedureOutcome::refused(
          fmt::format("no travel: the trial takes {:.2f} m of {:.2f} m", settings.trial_distance_m,
                      track.length_m()));
    }
    std::vector<Critical> curve;
    std::vector<std::string> lost;
    std::optional<Critical> chosen;
    const auto look = [&](double amplitude) {
      const auto data = oscillate(context, amplitude);
      const auto found = critical_in(data.console);
      if (!data.trouble.empty() || !found) {
        // Where friction gives the amplitude two values it need not settle: the others stand.
        lost.push_back(
            fmt::format("{:.2f} mm: {}", 1e3 * amplitude,
                        data.trouble.empty() ? "the controller's report lacks K_C" : data.trouble));
        return;
      }
      curve.push_back(*found);
      if (!chosen || std::fabs(amplitude - settings.chosen_m) <
                         std::fabs(chosen->amplitude_m - settings.chosen_m)) {
        chosen = found;
      }
      context.tell(0.9 * static_cast<double>(curve.size()) /
                   static_cast<double>(settings.amplitudes_m.size()));
    };
    double least_m = settings.chosen_m;
    for (const double amplitude : settings.amplitudes_m) {
      look(amplitude);
      least_m = std::min(least_m, amplitude);
    }
    // The larger the swing, the wider the range in which it has two values: so smaller ones.
    while (chosen && 2 * curve.size() < settings.amplitudes_m.size() && least_m > kSmallest_m) {
      least_m = std::max(kSmallest_m, kSmaller * least_m);
      look(least_m);
    }
    if (!chosen || 2 * curve.size() < settings.amplitudes_m.size()) {
      return ProcedureOutcome::failed(fmt::format("no oscillation of {}", fmt::join(lost, "; ")));
    }
    const auto stiffest = *std::max_element(
        curve.begin(), curve.end(),
        [](const Critical& a, const Critical& b) { return a.gain_Nm_per_rad < b.gain_Nm_per_rad; });
    std::string why;
    for (const auto& [of, share] :
         {std::pair(*chosen, 1.0), std::pair(stiffest, 1.0), std::pair(stiffest, 1.5),
          std::pair(*chosen, 0.7), std::pair(*chosen, 0.5)}) {
      const auto gains = gains_of(of, share);
      const auto trial = try_gains(context, settings, gains);
      if (trial.trouble.empty()) {
        return judged(context, curve, lost, of, {.share = share, .gains = gains, .run = trial});
      }
      why += fmt::format("{}{:.0f} % at {:.2f} mm: {}", why.empty() ? "" : "; ", 100 * share,
                         1e3 * of.amplitude_m, trial.trouble);
    }
    return ProcedureOutcome::failed("the loop with shares of Table 4.1's gains: " + why);
  }

 private:
  struct Trial {
    double share = 1;  // of Table 4.1
    std::string gains;
    identify::Recording run;
  };

  // Friction makes the relay's K_C too small where its amplitude is large, and a soft loop hunts
  // until the encoder's guard takes it for a broken one: then the stiffest of the curve, and more.
  // Where a transmission takes more of the phase than the relay met they are too much: then less.
  static std::string gains_of(const Critical& chosen, double share) {
    const auto p = number_after(chosen.gains, "--kp ");
    const auto i = number_after(chosen.gains, "--ki ");
    const auto d = number_after(chosen.gains, "--kd ");
    if (share == 1 || !p || !i || !d) {
      return chosen.gains;
    }
    return fmt::format(" --kp {:.9f}Nm/rad --ki {:.9f}Nm/(rad*s) --kd {:.9f}Nm*s/rad", share * *p,
                       share * *i, share * *d);
  }

  static identify::Recording oscillate(const ProcedureContext& context, double amplitude_m) {
    Conversation talk{.name =
                          fmt::format("tuning-{}-{}", core::name_of(context.axis), amplitude_m)};
    talk.start_m = middle_of_tracks(context.machine);
    talk.keeps_idle_rows = false;
    talk.steps = declare_position(talk, context.machine);
    talk.steps.push_back(move(fmt::format("rmpi pid {} --amplitude {:.4f}mm",
                                          core::name_of(context.axis), 1e3 * amplitude_m),
                              300));
    talk.limit_s = 320;
    return context.machine.play(talk, studied_configuration(context));
  }

  static identify::Recording try_gains(const ProcedureContext& context,
                                       const RelayTuningSettings& settings,
                                       const std::string& gains) {
    Conversation talk{.name = fmt::format("tuning-{}-trial", core::name_of(context.axis))};
    talk.start_m = middle_of_tracks(context.machine);
    talk.steps = declare_position(talk, context.machine);
    talk.steps.push_back(say(fmt::format("config gains {}{}", core::name_of(context.axis), gains)));
    for (const double sign : {1.0, -1.0}) {
      talk.steps.push_back(move(
          fmt::format("run -trapez {} --distance {}m --speed {}m/s", core::name_of(context.axis),
                      sign * settings.trial_distance_m, settings.trial_speed_m_per_s)));
    }
    talk.limit_s = 120;
    return context.machine.play(talk, studied_configuration(context));
  }

  static ProcedureOutcome judged(const ProcedureContext& context,
                                 const std::vector<Critical>& curve,
                                 const std::vector<std::string>& lost, const Critical& chosen,
                                 const Trial& trial) {
    // The controller ends its search within 5 % of the amplitude, and counts 8 periods in ticks.
    constexpr double kGainStandardError = 0.02;
    ProcedureOutcome outcome;
    const auto scale = torque_scale(context);
    const auto add = [&](const char* quantity, double value, double standard_error,
                         const char* unit, double amplitude_m) {
      outcome.estimates.push_back(identify::with_standard_error(
          {.quantity = quantity,
           .axis = std::string(core::name_of(context.axis)),
           .value = value,
           .unit = unit,
           .rests_on = fmt::format("the controller's relay at an amplitude of {:.3f} mm; torque by "
                                   "{}",
                                   1e3 * amplitude_m,
                                   scale.measured ? "EXP-P-1" : "the believed K_T K_amp"),
           .procedure = "tuning",
           .at = amplitude_m},
          standard_error));
    };
    Curve gains{.name = "K_C", .mark = Mark::kDots};
    ResultTable table{.title = "Critical gain by amplitude",
                      .head = {"amplitude, mm", "K_C, N m/rad", "T_C, ms", "relay, mN m"}};
    for (const auto& each : curve) {
      add("critical_gain_Nm_per_rad", each.gain_Nm_per_rad,
          each.gain_Nm_per_rad * std::hypot(kGainStandardError, scale.relative_standard_error),
          "N m/rad", each.amplitude_m);
      add("critical_period_s", each.period_s, 0.01 * each.period_s, "s", each.amplitude_m);
      gains.x.push_back(1e3 * each.amplitude_m);
      gains.y.push_back(1e3 * each.gain_Nm_per_rad);
      table.rows.push_back({fmt::format("{:.3f}", 1e3 * each.amplitude_m),
                            fmt::format("{:.5f}", each.gain_Nm_per_rad),
                            fmt::format("{:.2f}", 1e3 * each.period_s),
                            fmt::format("{:.2f}", 1e3 * each.relay_Nm)});
    }
    double square = 0;
    double peak = 0;
    std::size_t rows = 0;
    const auto& run = trial.run;
    const auto& axis = run.axes[context.axis];
    for (std::size_t k = 0; k < run.rows(); ++k) {
      if (axis.reference_velocity_m_per_s[k] != 0) {
        const double error = axis.reference_m[k] - run.position_m(context.axis, k);
        square += error * error;
        peak = std::max(peak, std::fabs(error));
        ++rows;
      }
    }
    outcome.tables.push_back(std::move(table));
    if (!lost.empty()) {
      ResultTable without{.title = "No oscillation", .head = {"amplitude, and why"}};
      for (const auto& each : lost) {
        without.rows.push_back({each});
      }
      outcome.tables.push_back(std::move(without));
    }
    outcome.tables.push_back(
        {.title = fmt::format("{:.0f} % of the gains of Table 4.1 at {:.3f} mm, errata applied",
                              100 * trial.share, 1e3 * chosen.amplitude_m),
         .head = {"config gains", "trapezoid: RMS, um", "peak, um"},
         .rows = {
             {trial.gains,
              fmt::format("{:.1f}", 1e6 * std::sqrt(square / static_cast<double>(
                                                                 std::max<std::size_t>(rows, 1)))),
              fmt::format("{:.0f}", 1e6 * peak)}}});
    outcome.figures.push_back({.title = "Critical gain against amplitude",
                               .x_label = "amplitude, mm",
                               .y_label = "K_C, mN m/rad",
                               .curves = {std::move(gains)},
                               .caption = "Friction makes it depend on the amplitude."});
    return outcome;
  }
};

}  // namespace

std::unique_ptr<Procedure> relay_tuning() {
  return std::make_unique<RelayTuning>();
}

}  // namespace towbench::study::procedures
