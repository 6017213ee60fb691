// EXP-4: a manoeuvring body with dynamics of its own (drag, added mass, a working fin) is led along
// a path of several kinds of segments; tracking error of each, with the body and without.
#include <array>
#include <cmath>

#include <fmt/format.h>

#include "study/procedures/settings.h"
#include "study/procedures/tow/feasibility.h"
#include "study/procedures/tow/tow_procedure.h"
#include "study/procedures/tow/tracking_errors.h"
#include "study/procedures/tow/weigh_drive.h"

namespace towbench::study::procedures {
namespace {

using core::Axis;

struct Exp4Settings {
  double start_y_m = 0.8;
  double start_x_m = 0.3368;
  double speed_m_per_s = 0.25;
  double largest_peak_m = 1e-3;  // TRK-2: plain PID, motor side
  double expected_load_N = 5.0;  // what the body may push with; assumed, a few times its thrust

  template <typename Visitor>
  void visit(Visitor& v) {
    v.value("start_y_m", start_y_m, core::between(0.0, 10.0), "where the path begins");
    v.value("start_x_m", start_x_m, core::between(0.0, 10.0), "where the path begins");
    v.value("speed_m_per_s", speed_m_per_s, core::between(0.01, 0.35), "of the straight segment");
    v.value("largest_peak_m", largest_peak_m, core::between(1e-6, 1.0),
            "of the tracking error of any axis in any segment, motor side");
    v.value("expected_load_N", expected_load_N, core::between(0.0, 25.0),
            "of the body on an axis; the controller's encoder check allows for it");
  }
};

struct Segment {
  std::string name;
  std::string command;
};

std::vector<Segment> segments(const Exp4Settings& s) {
  return {{"straight", fmt::format("run -trapez y --distance 1.2m --speed {:.3f}m/s "
                                   "--acceleration 0.8s --smooth 0.243s",
                                   s.speed_m_per_s)},
          {"circle", "run -circle --radius 0.15m --period 6s --turns 2"},
          {"slalom", "run -spatial --distance -0.9m --speed 0.1m/s --amplitude 0.06m --waves 3"},
          {"ellipse", "run -ellipse --radius-y 0.2m --radius-x 0.1m --period 7s --turns 2"}};
}

Conversation path(const Machine& machine, const std::string& name, const Exp4Settings& s) {
  Conversation talk;
  talk.name = name;
  talk.start_m[Axis::kY] = s.start_y_m;
  talk.start_m[Axis::kX] = s.start_x_m;
  talk.steps = declare_position(talk, machine);
  for (const auto& segment : segments(s)) {
    talk.steps.push_back(move(segment.command));
    talk.steps.back().wait_s = 0.3;  // off for a moment: segments are told apart by that
  }
  talk.limit_s = 300;
  return talk;
}

struct Stretch {
  std::size_t first = 0;
  std::size_t last = 0;
};

// Rows between pauses of all axes.
std::vector<Stretch> driven(const identify::Recording& run) {
  std::vector<Stretch> found;
  bool was = false;
  for (std::size_t i = 0; i < run.rows(); ++i) {
    const bool is = run.axes[Axis::kY].mode[i] != 0 || run.axes[Axis::kX].mode[i] != 0;
    if (is && !was) {
      found.push_back({i, i});
    }
    if (is) {
      found.back().last = i + 1;
    }
    was = is;
  }
  return found;
}

class Manoeuvres final : public TowProcedure {
 public:
  [[nodiscard]] std::string_view id() const noexcept override { return "EXP-4"; }
  [[nodiscard]] std::string_view title() const noexcept override {
    return "path following with a manoeuvring body";
  }
  void check_settings(const std::filesystem::path& file) const override {
    static_cast<void>(read_settings<Exp4Settings>(file, Axis::kY));
  }
  [[nodiscard]] Load load() const override { return {.rig = "tow-fin"}; }

  [[nodiscard]] TowOutcome run(const TowContext& context) const override {
    const auto s = read_settings<Exp4Settings>(context.settings, Axis::kY);
    const auto dry = context.loads.with({});
    const auto wet = context.loads.with(load());
    for (auto why :
         {no_axis(wet, Axis::kY), no_axis(wet, Axis::kX), not_in_water(context.loads, load()),
          too_fast(wet, Axis::kY, s.speed_m_per_s, 0.0),
          no_travel(wet, Axis::kY, s.start_y_m, s.start_y_m + 1.5),
          no_travel(wet, Axis::kX, s.start_x_m - 0.15, s.start_x_m + 0.15)}) {
      if (!why.empty()) {
        return tow_refused(why);
      }
    }
    const auto with =
        wet.play(path(wet, "with the body", s), expecting_load(wet, s.expected_load_N));
    const auto without = dry.play(path(dry, "without the body", s));
    for (const auto* each : {&with, &without}) {
      if (!each->trouble.empty()) {
        return tow_failed(each->trouble);
      }
    }
    return told(with, without, s);
  }

 private:
  static TowOutcome told(const identify::Recording& with, const identify::Recording& without,
                         const Exp4Settings& s) {
    const auto names = segments(s);
    const auto stretches = driven(with);
    const auto alone = driven(without);
    if (stretches.size() != names.size() || alone.size() != names.size()) {
      return tow_failed("the segments of the path cannot be told apart in the log");
    }
    TowOutcome outcome;
    ResultTable table{.title = "EXP-4: tracking error per segment, motor side, um",
                      .head = {"segment", "Y RMS", "Y peak", "X RMS", "X peak",
                               "without the body: Y peak", "X peak"}};
    for (std::size_t k = 0; k < names.size(); ++k) {
      std::array<TrackingErrors, 4> errors{};
      std::size_t next = 0;
      for (const auto& [run, stretch] :
           {std::pair{&with, stretches[k]}, std::pair{&without, alone[k]}}) {
        for (const auto axis : core::kPlanarAxes) {
          errors[next++] = tracking_errors(*run, axis, stretch.first, stretch.last);
        }
      }
      const auto um = [](double metres) { return fmt::format("{:.1f}", 1e6 * metres); };
      table.rows.push_back({names[k].name, um(errors[0].rms_m), um(errors[0].peak_m),
                            um(errors[1].rms_m), um(errors[1].peak_m), um(errors[2].peak_m),
                            um(errors[3].peak_m)});
      for (const auto& error : {errors[0], errors[1]}) {
        if (error.peak_m > s.largest_peak_m) {
          outcome.status = ProcedureOutcome::Status::kFailed;
          outcome.reason = fmt::format("{}: tracking error up to {:.2f} mm, {:.2f} mm allowed",
                                       names[k].name, 1e3 * error.peak_m, 1e3 * s.largest_peak_m);
        }
      }
    }
    outcome.tables = {std::move(table)};
    return outcome;
  }
};

}  // namespace

std::unique_ptr<TowProcedure> manoeuvres() {
  return std::make_unique<Manoeuvres>();
}

}  // namespace towbench::study::procedures
