// EXP-P-1: K_T and K_amp, from current monitor and force sensor.
//
// The thesis locks the shaft. Then friction holds an unknown part of the torque, so here the axis
// creeps at a steady speed, forth and back over the same stretch, while its load is pushed with a
// force and then with the opposite one: what friction takes is the same and falls out.
#include <cmath>

#include <fmt/format.h>

#include "study/identify/drive_constants.h"
#include "study/procedures/procedures.h"
#include "study/procedures/settings.h"

namespace towbench::study::procedures {
namespace {

struct DriveCalibrationSettings {
  double push_N = 15;
  double speed_m_per_s = 0.05;
  double distance_m = 0.35;

  template <typename Visitor>
  void visit(Visitor& v) {
    v.value("push_N", push_N, core::between(0.5, 200), "on the load, one way and the other");
    v.value("speed_m_per_s", speed_m_per_s, core::between(0.005, 0.3), "steady");
    v.value("distance_m", distance_m, core::between(0.05, 2), "of each run");
  }
};

constexpr double kWait_s = 1;
constexpr double kRise_s = 0.3;
constexpr double kLeans = 0.1;  // of the cruise: when the push begins
constexpr int kStretches = 3;   // of each pushed run, each reaching half way into the next

class DriveCalibration final : public Procedure {
 public:
  [[nodiscard]] std::string_view id() const noexcept override { return "EXP-P-1"; }
  [[nodiscard]] std::string_view title() const noexcept override { return "K_T and K_amp"; }
  void check_settings(const std::filesystem::path& file) const override {
    static_cast<void>(read_settings<DriveCalibrationSettings>(file, core::Axis::kY));
  }

  [[nodiscard]] ProcedureOutcome run(const ProcedureContext& context) const override {
    const auto settings = read_settings<DriveCalibrationSettings>(context.settings, context.axis);
    const auto why = refusal(context, settings);
    if (!why.empty()) {
      return ProcedureOutcome::refused(why);
    }
    const double cruise_s = settings.distance_m / settings.speed_m_per_s - kRise_s;
    const double every_s = kWait_s + 2 * kRise_s + cruise_s + 2;
    const auto data = play(context, settings, cruise_s, every_s);
    if (!data.trouble.empty()) {
      return ProcedureOutcome::failed(data.trouble);
    }
    const auto& plate = context.machine.nameplate(context.axis);
    std::vector<identify::PushedRun> runs;
    std::vector<identify::PushedRun> free;
    const auto mean_between = [&](int i, int stretch, double from_share, double to_share) {
      const double start_s = 1 + i * every_s + kWait_s + kRise_s;
      const auto from = identify::row_at(data, start_s + from_share * cruise_s);
      const auto to = identify::row_at(data, start_s + to_share * cruise_s);
      identify::PushedRun run;
      run.towards_max = i % 2 == 0;
      run.stretch = stretch;
      run.current_A = identify::smooth_mean_of(data.axes[context.axis].current_A, from, to);
      run.force_N = identify::smooth_mean_of(data.force_N[context.axis], from, to);
      run.command_V = identify::smooth_mean_of(data.axes[context.axis].duty_pct, from, to);
      run.command_V.value *= plate.pwm_amplitude_V / 100;
      return run;
    };
    for (int i = 0; i < 4; ++i) {
      // The middle of the pushed stretch, the same way in both directions: the transmission has
      // come to rest but for the carriage's swing on a motor that is held, which a smooth mean over
      // some periods takes out.
      for (int stretch = 0; stretch < kStretches; ++stretch) {
        const auto edge = [](int of) { return 0.28 + (0.72 - 0.28) * of / (kStretches + 1); };
        runs.push_back(mean_between(i, stretch, edge(stretch), edge(stretch + 2)));
      }
      // Before the push and after it, as far from the middle on both sides.
      free.push_back(mean_between(i, 0, 0.01, kLeans));
      free.push_back(mean_between(i, 0, 1 - kLeans, 0.99));
    }
    return judged(context, runs, identify::bend_under_load(runs, free));
  }

 private:
  static std::string refusal(const ProcedureContext& context,
                             const DriveCalibrationSettings& settings) {
    const auto& plate = context.machine.nameplate(context.axis);
    const auto& belief = context.machine.configuration().axes[context.axis];
    if (!context.machine.has_force_sensor()) {
      return "no force sensor: no torque can be told";
    }
    if (!plate.has_current_monitor) {
      return "no current monitor: K_T and K_amp cannot be told apart";
    }
    const double needed_Nm =
        settings.push_N * plate.metres_per_motor_rad() + belief.plausibility.worst_breakaway_Nm;
    if (needed_Nm > 0.6 * belief.drive.torque_limit_Nm()) {
      return fmt::format("stall: a push of {} N takes {:.2g} N m of {:.2g}", settings.push_N,
                         needed_Nm, belief.drive.torque_limit_Nm());
    }
    const auto track = track_of(belief);
    if (settings.distance_m > 0.8 * track.length_m()) {
      return fmt::format("no travel: {} m of {:.2f} m", settings.distance_m, track.length_m());
    }
    return {};
  }

  // A hand does not strike: it leans on within half a second.
  static void lean(Conversation& talk, core::Axis axis, double time_s, double from_N, double to_N) {
    constexpr int kSteps = 50;
    constexpr double kLean_s = 0.5;
    for (int i = 1; i <= kSteps; ++i) {
      emulator::ScheduledEvent event;
      event.time_ns = core::nanoseconds(time_s + kLean_s * i / kSteps);
      event.kind = emulator::ScheduledEventKind::kPushCarriage;
      event.axis = axis;
      event.value = from_N + (to_N - from_N) * i / kSteps;
      talk.events.push_back(event);
    }
  }

  static identify::Recording play(const ProcedureContext& context,
                                  const DriveCalibrationSettings& settings, double cruise_s,
                                  double every_s) {
    Conversation talk{.name = fmt::format("EXP-P-1-{}", core::name_of(context.axis))};
    talk.start_m = middle_of_tracks(context.machine);
    talk.start_m[context.axis] -= 0.5 * settings.distance_m;
    talk.steps = declare_position(talk, context.machine);
    for (int i = 0; i < 4; ++i) {
      auto step = move(
          fmt::format("run -trapez {} --distance {}m --speed {}m/s --acceleration {}s --wait {}s",
                      core::name_of(context.axis), (i % 2 == 0 ? 1 : -1) * settings.distance_m,
                      settings.speed_m_per_s, kRise_s, kWait_s));
      step.at_s = 1 + i * every_s;
      talk.steps.push_back(step);
      const double start_s = 1 + i * every_s + kWait_s + kRise_s;
      const double push_N = i < 2 ? settings.push_N : -settings.push_N;
      lean(talk, context.axis, start_s + kLeans * cruise_s, 0, push_N);
      lean(talk, context.axis, start_s + 0.82 * cruise_s, push_N, 0);
    }
    talk.limit_s = 5 * every_s + 10;
    auto configuration = context.machine.configuration();
    configuration.axes[context.axis].plausibility.external_load_N = 1.5 * settings.push_N;
    return context.machine.play(talk, configuration);
  }

  static ProcedureOutcome judged(const ProcedureContext& context,
                                 const std::vector<identify::PushedRun>& runs, double bend) {
    const auto found = identify::find_drive_constants(
        runs, context.machine.nameplate(context.axis).metres_per_motor_rad());
    if (!found.found) {
      return ProcedureOutcome::failed("neither force nor current followed the push");
    }
    ProcedureOutcome outcome;
    // Less is what friction by place and the transmission's swing do to the unpushed runs.
    const double loss = bend > kStraight ? bend : 0;
    const auto bent = loss == 0 ? std::string()
                                : fmt::format(
                                      "; the current is {:.1f} % off a straight line over "
                                      "the force: a loss that grows with the load",
                                      100 * bend);
    const auto add = [&](const char* quantity, double value, double standard_error,
                         const char* unit, const std::string& rests_on, double model_error = 0) {
      auto estimate =
          identify::with_standard_error({.quantity = quantity,
                                         .axis = std::string(core::name_of(context.axis)),
                                         .value = value,
                                         .unit = unit,
                                         .rests_on = rests_on,
                                         .procedure = "EXP-P-1"},
                                        kOverlap * standard_error);
      estimate.low -= model_error * value;
      estimate.high += model_error * value;
      outcome.estimates.push_back(std::move(estimate));
    };
    add("torque_constant_Nm_per_A", found.torque_constant_Nm_per_A,
        found.torque_constant_standard_error, "N m/A",
        "current monitor and force sensor at one speed under opposite pushes; gear and wheel by "
        "their drawings, no loss in the gear, sensors linear" +
            bent,
        loss);
    add("amplifier_gain_A_per_V", found.amplifier_gain_A_per_V, found.amplifier_gain_standard_error,
        "A/V", "current monitor over the mean of the duty written");
    add("torque_per_volt_Nm_per_V", found.torque_constant_Nm_per_A * found.amplifier_gain_A_per_V,
        found.torque_constant_Nm_per_A * found.amplifier_gain_A_per_V *
            found.torque_per_volt_standard_error,
        "N m/V", "force sensor over the mean of the duty written; no current monitor" + bent, loss);
    ResultTable table{.title = "Steady runs under a push, the middle stretch of each",
                      .head = {"direction", "force, N", "current, A", "command, V"}};
    for (const auto& run : runs) {
      if (run.stretch != kStretches / 2) {
        continue;
      }
      table.rows.push_back({run.towards_max ? "+" : "-", fmt::format("{:.3f}", run.force_N.value),
                            fmt::format("{:.4f}", run.current_A.value),
                            fmt::format("{:.4f}", run.command_V.value)});
    }
    outcome.tables.push_back(std::move(table));
    return outcome;
  }

  static constexpr double kStraight = 0.02;
  // Two raised cosines that half overlap share a sixth (Harris 1978), so of three the mean is by
  // (1 + 2/3 * 2/6) less sure and the scatter by (1 - 2/3 * 1/6) less than of three that do not.
  static constexpr double kOverlap = 1.173;  // root of 1.222 / 0.889
};

}  // namespace

std::unique_ptr<Procedure> drive_calibration() {
  return std::make_unique<DriveCalibration>();
}

}  // namespace towbench::study::procedures
