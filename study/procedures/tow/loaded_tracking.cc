// FR-3 and FR-7: 20 N at the end-effector, and one axis moving while the other holds.
#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "study/identify/tow/steady_span.h"
#include "study/procedures/settings.h"
#include "study/procedures/tow/feasibility.h"
#include "study/procedures/tow/tow_procedure.h"
#include "study/procedures/tow/tracking_errors.h"
#include "study/procedures/tow/weigh_drive.h"

namespace towbench::study::procedures {
namespace {

using core::Axis;

struct LoadSettings {
  double load_N = 20.0;           // FR-3
  double unloaded_peak_m = 1e-3;  // TRK-2: plain PID
  double start_y_m = 0.450;
  double start_x_m = 0.12;
  double speed_y_m_per_s = 0.2;
  double speed_x_m_per_s = 0.1;
  double distance_y_m = 1.6;
  double distance_x_m = 0.45;

  template <typename Visitor>
  void visit(Visitor& v) {
    v.value("load_N", load_N, core::between(0.1, 60.0), "against the motion");
    v.value("unloaded_peak_m", unloaded_peak_m, core::between(1e-6, 0.1),
            "budget without a load; twice that with it");
    v.value("start_y_m", start_y_m, core::between(0.0, 10.0), "where Y begins");
    v.value("start_x_m", start_x_m, core::between(0.0, 10.0), "where X begins");
    v.value("speed_y_m_per_s", speed_y_m_per_s, core::between(1e-3, 1.0), "of Y");
    v.value("speed_x_m_per_s", speed_x_m_per_s, core::between(1e-3, 1.0), "of X");
    v.value("distance_y_m", distance_y_m, core::between(0.01, 10.0), "of Y");
    v.value("distance_x_m", distance_x_m, core::between(0.01, 10.0), "of X");
  }
  [[nodiscard]] double speed(Axis axis) const {
    return axis == Axis::kY ? speed_y_m_per_s : speed_x_m_per_s;
  }
  [[nodiscard]] double distance(Axis axis) const {
    return axis == Axis::kY ? distance_y_m : distance_x_m;
  }
  [[nodiscard]] double start(Axis axis) const { return axis == Axis::kY ? start_y_m : start_x_m; }
};

constexpr double kTyped_s = 1.5;
constexpr double kRamp_s = 0.8;
constexpr double kSmooth_s = 0.243;

// The load begins and ends with the motion at speed.
Conversation trapezoid(const Machine& machine, Axis axis, const LoadSettings& s, double load_N) {
  Conversation talk;
  talk.name = fmt::format("{} with {:.0f} N", core::name_of(axis), load_N);
  for (const auto each : core::kPlanarAxes) {
    talk.start_m[each] = s.start(each);
  }
  talk.steps = declare_position(talk, machine);
  talk.steps.push_back(move(fmt::format(
      "run -trapez {} --distance {:.4f}m --speed {:.4f}m/s --acceleration {:.3f}s --smooth "
      "{:.3f}s --wait 0.5s",
      core::name_of(axis), s.distance(axis), s.speed(axis), kRamp_s, kSmooth_s)));
  talk.steps.back().at_s = kTyped_s;
  const double begin_s = kTyped_s + 0.5 + kRamp_s + kSmooth_s + 0.2;
  const double end_s = kTyped_s + 0.5 + s.distance(axis) / s.speed(axis) - 0.2;
  if (load_N != 0) {
    for (const auto& [time_s, force_N] : {std::pair{begin_s, -load_N}, std::pair{end_s, 0.0}}) {
      talk.events.push_back({.time_ns = core::nanoseconds(time_s),
                             .kind = emulator::ScheduledEventKind::kPushCarriage,
                             .axis = axis,
                             .value = force_N});
    }
  }
  talk.limit_s = 120;
  return talk;
}

double rms_about_mean(std::span<const double> samples) {
  double mean = 0;
  double squares = 0;
  for (const double each : samples) {
    mean += each / static_cast<double>(samples.size());
  }
  for (const double each : samples) {
    squares += (each - mean) * (each - mean);
  }
  return std::sqrt(squares / static_cast<double>(samples.size()));
}

// What the resting axis's force sensor feels of the moving one: change of its mean from rest to
// steady motion, and its noise at rest.
struct CrossForce {
  double change_N = 0;
  double noise_N = 0;
};

CrossForce cross_force(const identify::Recording& run, Axis moving) {
  const auto spans = identify::steady_spans(run, moving, 0.2);
  const std::span<const double> column = run.force_N[moving == Axis::kY ? Axis::kX : Axis::kY];
  const auto rest = column.subspan(100, 1000);
  const auto at_speed = column.subspan(spans.at(0).first, spans.at(0).rows());
  const auto mean = [](std::span<const double> samples) {
    double sum = 0;
    for (const double each : samples) {
      sum += each;
    }
    return sum / static_cast<double>(samples.size());
  };
  return {mean(at_speed) - mean(rest), rms_about_mean(rest)};
}

class LoadedTracking final : public TowProcedure {
 public:
  [[nodiscard]] std::string_view id() const noexcept override { return "load"; }
  [[nodiscard]] std::string_view title() const noexcept override {
    return "20 N at the end-effector (FR-3), cross axis (FR-7)";
  }
  void check_settings(const std::filesystem::path& file) const override {
    static_cast<void>(read_settings<LoadSettings>(file, Axis::kY));
  }
  [[nodiscard]] Load load() const override { return {}; }

  [[nodiscard]] TowOutcome run(const TowContext& context) const override {
    const auto s = read_settings<LoadSettings>(context.settings, Axis::kY);
    const auto machine = context.loads.with(load());
    for (const auto axis : core::kPlanarAxes) {
      for (auto why : {no_axis(machine, axis), no_force_sensor(machine),
                       too_fast(machine, axis, s.speed(axis), 0.0, s.load_N),
                       no_travel(machine, axis, s.start(axis), s.start(axis) + s.distance(axis)),
                       too_short(s.distance(axis), s.speed(axis), kRamp_s, kSmooth_s, 1.0)}) {
        if (!why.empty()) {
          return tow_refused(why);
        }
      }
    }
    TowOutcome outcome;
    ResultTable tracking{.title = "FR-3: tracking with a load at the end-effector, motor side, um",
                         .head = {"axis", "no load: RMS", "peak", "loaded: RMS", "peak"}};
    ResultTable cross{.title = "FR-7: force across a moving axis, N",
                      .head = {"moving", "change of the mean", "noise at rest, RMS"}};
    for (const auto axis : core::kPlanarAxes) {
      const auto configuration = expecting_load(machine, 1.5 * s.load_N);
      const auto plain = machine.play(trapezoid(machine, axis, s, 0), configuration);
      const auto loaded = machine.play(trapezoid(machine, axis, s, s.load_N), configuration);
      for (const auto* each : {&plain, &loaded}) {
        if (!each->trouble.empty()) {
          return tow_failed(each->trouble);
        }
      }
      const auto free = tracking_errors(plain, axis);
      const auto pulled = tracking_errors(loaded, axis);
      const auto across = cross_force(plain, axis);
      const auto um = [](double metres) { return fmt::format("{:.1f}", 1e6 * metres); };
      tracking.rows.push_back({std::string(core::name_of(axis)), um(free.rms_m), um(free.peak_m),
                               um(pulled.rms_m), um(pulled.peak_m)});
      cross.rows.push_back({std::string(core::name_of(axis)),
                            fmt::format("{:+.4f}", across.change_N),
                            fmt::format("{:.4f}", across.noise_N)});
      if (pulled.peak_m > 2 * s.unloaded_peak_m) {
        outcome.reason =
            fmt::format("{}: {:.2f} mm off with {:.0f} N, {:.2f} mm allowed", core::name_of(axis),
                        1e3 * pulled.peak_m, s.load_N, 2e3 * s.unloaded_peak_m);
      }
      if (std::fabs(across.change_N) > across.noise_N) {
        outcome.reason = fmt::format("{} moving pushes across by {:.3f} N, more than the noise",
                                     core::name_of(axis), across.change_N);
      }
    }
    if (!outcome.reason.empty()) {
      outcome.status = ProcedureOutcome::Status::kFailed;
    }
    outcome.tables = {std::move(tracking), std::move(cross)};
    outcome.simulated_s = machine.simulated_s();
    return outcome;
  }
};

}  // namespace

std::unique_ptr<TowProcedure> loaded_tracking() {
  return std::make_unique<LoadedTracking>();
}

}  // namespace towbench::study::procedures
