// EXP-5: thrust of the body's fin, from runs with and without actuation: held in place, and towed.
#include <cmath>

#include <fmt/format.h>

#include "study/identify/tow/paired_difference.h"
#include "study/identify/tow/spectral_line.h"
#include "study/procedures/settings.h"
#include "study/procedures/tow/feasibility.h"
#include "study/procedures/tow/tow_procedure.h"

namespace towbench::study::procedures {
namespace {

using core::Axis;
using identify::Recording;

struct Exp5Settings {
  double fin_from_s = 5.0;  // when the fin is switched on, as the load's own sheet says
  double hold_s = 40.0;
  double settle_s = 1.0;
  double start_y_m = 1.2;
  double start_x_m = 0.3368;
  double tow_speed_m_per_s = 0.10;
  double tow_distance_m = 1.5;
  double lowest_Hz = 0.2;
  double highest_Hz = 10.0;

  template <typename Visitor>
  void visit(Visitor& v) {
    v.value("fin_from_s", fin_from_s, core::between(2.0, 1e3), "when the fin is switched on");
    v.value("hold_s", hold_s, core::between(15.0, 60.0), "how long the body is held in place");
    v.value("settle_s", settle_s, core::between(0.1, 10.0), "after the switch, left out");
    v.value("start_y_m", start_y_m, core::between(0.0, 10.0), "where Y is held");
    v.value("start_x_m", start_x_m, core::between(0.0, 10.0), "where X is held");
    v.value("tow_speed_m_per_s", tow_speed_m_per_s, core::between(0.01, 1.0), "of the tow");
    v.value("tow_distance_m", tow_distance_m, core::between(0.1, 10.0), "of the tow, towards max");
    v.value("lowest_Hz", lowest_Hz, core::between(0.01, 100.0), "of the thrust's frequency");
    v.value("highest_Hz", highest_Hz, core::between(0.1, 100.0), "of the thrust's frequency");
  }
};

Conversation conversation(const Machine& machine, const std::string& name, const Exp5Settings& s,
                          const std::string& command, double from_s) {
  Conversation talk;
  talk.name = name;
  talk.start_m[Axis::kY] = s.start_y_m;
  talk.start_m[Axis::kX] = s.start_x_m;
  talk.steps = declare_position(talk, machine);
  talk.steps.push_back(move(command));
  talk.steps.back().at_s = from_s;
  talk.limit_s = 200;
  return talk;
}

std::span<const double> between(const Recording& run, std::span<const double> column, double from_s,
                                double to_s) {
  const auto row = [&](double time_s) {
    return std::min(column.size(), static_cast<std::size_t>(
                                       std::lround((time_s - run.time_s.front()) / run.period_s)));
  };
  return column.subspan(row(from_s), row(to_s) - row(from_s));
}

// The fin rests until it is switched on, and the machine stands: the sensor's zero.
identify::UncertainMean zero_of(const Recording& run, const Exp5Settings& s) {
  return identify::block_mean(between(run, run.force_N[Axis::kY], 0.2, s.fin_from_s - 0.1),
                              identify::block_rows(run));
}

class FinThrustTow final : public TowProcedure {
 public:
  [[nodiscard]] std::string_view id() const noexcept override { return "EXP-5"; }
  [[nodiscard]] std::string_view title() const noexcept override { return "thrust of the fin"; }
  void check_settings(const std::filesystem::path& file) const override {
    static_cast<void>(read_settings<Exp5Settings>(file, Axis::kY));
  }
  [[nodiscard]] Load load() const override { return {.rig = "tow-fin"}; }

  [[nodiscard]] TowOutcome run(const TowContext& context) const override {
    const auto s = read_settings<Exp5Settings>(context.settings, Axis::kY);
    auto resting = load();
    resting.fin_works = false;
    const auto working = context.loads.with(load());
    const auto still = context.loads.with(resting);
    for (auto why : {no_force_sensor(working), not_in_water(context.loads, load()),
                     too_fast(working, Axis::kY, s.tow_speed_m_per_s, 0.0),
                     no_travel(working, Axis::kY, s.start_y_m, s.start_y_m + s.tow_distance_m),
                     too_short(s.tow_distance_m, s.tow_speed_m_per_s, 0.8, 0.243, 5.0)}) {
      if (!why.empty()) {
        return tow_refused(why);
      }
    }
    // The controller holds both axes while a motion waits to begin.
    const auto hold =
        fmt::format("run -trapez y --distance 0.01m --speed 0.01m/s --wait {:.1f}s", s.hold_s);
    const auto held = working.play(conversation(working, "held", s, hold, 0.5));
    const auto tow = fmt::format(
        "run -trapez y --distance {:.3f}m --speed {:.4f}m/s --acceleration 0.8s --smooth 0.243s",
        s.tow_distance_m, s.tow_speed_m_per_s);
    const double tow_from_s = s.fin_from_s + s.settle_s;
    const auto with = working.play(conversation(working, "towed, fin on", s, tow, tow_from_s));
    const auto without = still.play(conversation(still, "towed, fin off", s, tow, tow_from_s));
    for (const auto* each : {&held, &with, &without}) {
      if (!each->trouble.empty()) {
        return tow_failed(each->trouble);
      }
    }
    return estimate(held, with, without, s);
  }

 private:
  static TowOutcome estimate(const Recording& held, const Recording& with, const Recording& without,
                             const Exp5Settings& s) {
    const auto on = between(held, held.force_N[Axis::kY], s.fin_from_s + s.settle_s, s.hold_s);
    const auto side = between(held, held.force_N[Axis::kX], s.fin_from_s + s.settle_s, s.hold_s);
    const auto line = identify::strongest_line(on, held.period_s, s.lowest_Hz, s.highest_Hz);
    const auto side_line = identify::strongest_line(side, held.period_s, s.lowest_Hz, s.highest_Hz);
    if (!line || !side_line) {
      return tow_failed("the record is too short for the fin's frequency");
    }
    const auto mean =
        identify::mean_over_periods(on, held.period_s, 0.5 * line->frequency_Hz.value);
    const auto towed = towed_thrust(with, without, s, line->frequency_Hz.value);
    if (!mean || !towed) {
      return tow_failed("too few strokes of the fin in the record");
    }
    const auto held_thrust = identify::combine(1.0, *mean, -1.0, zero_of(held, s));
    TowOutcome outcome;
    const auto add = [&](const identify::UncertainMean& value, const char* quantity,
                         const char* unit, const char* rests_on) {
      outcome.estimates.push_back(identify::to_estimate(value, quantity, "", unit, rests_on));
    };
    add(held_thrust, "held_thrust_N", "N",
        "force sensor, body held in place, whole strokes, less before the fin was on");
    add(*towed, "towed_thrust_N", "N",
        "force sensor at steady speed, fin on less fin off, whole strokes");
    add(line->frequency_Hz, "thrust_frequency_Hz", "Hz", "phase of the strongest line over time");
    add(line->amplitude, "thrust_amplitude_N", "N", "least squares at that frequency");
    add(side_line->frequency_Hz, "side_frequency_Hz", "Hz", "as the thrust's, across the body");
    outcome.figures = {record_figure(held, on, side, s)};
    return outcome;
  }

  static std::optional<identify::UncertainMean> towed_thrust(const Recording& with,
                                                             const Recording& without,
                                                             const Exp5Settings& s,
                                                             double frequency_Hz) {
    const auto a = identify::steady_spans(with, Axis::kY, s.settle_s);
    const auto b = identify::steady_spans(without, Axis::kY, s.settle_s);
    if (a.size() != 1 || b.size() != 1) {
      return std::nullopt;
    }
    const std::size_t rows = std::min(a[0].rows(), b[0].rows());
    std::vector<double> rest(rows);
    for (std::size_t i = 0; i < rows; ++i) {
      rest[i] = with.force_N[Axis::kY][a[0].first + i] - without.force_N[Axis::kY][b[0].first + i];
    }
    auto mean = identify::mean_over_periods(rest, with.period_s, 0.5 * frequency_Hz);
    if (mean) {
      const auto zero = identify::combine(1.0, zero_of(with, s), -1.0, zero_of(without, s));
      mean = identify::combine(1.0, *mean, -1.0, zero);
    }
    return mean;
  }

  static Figure record_figure(const Recording& held, std::span<const double> on,
                              std::span<const double> side, const Exp5Settings& s) {
    Figure figure{.title = "Force of the fin, body held in place",
                  .x_label = "time, s",
                  .y_label = "N",
                  .caption = {}};
    constexpr std::size_t kRows = 3000;
    constexpr std::size_t kEvery = 10;
    for (const auto& [name, column] : {std::pair{"forward", on}, std::pair{"sideways", side}}) {
      Curve curve{.name = name};
      for (std::size_t i = 0; i < std::min(kRows, column.size()); i += kEvery) {
        curve.x.push_back(s.fin_from_s + s.settle_s + static_cast<double>(i) * held.period_s);
        curve.y.push_back(column[i]);
      }
      figure.curves.push_back(std::move(curve));
    }
    return figure;
  }
};

}  // namespace

std::unique_ptr<TowProcedure> fin_thrust() {
  return std::make_unique<FinThrustTow>();
}

}  // namespace towbench::study::procedures
