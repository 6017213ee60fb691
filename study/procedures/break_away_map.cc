// EXP-OL-1: break-away torque along the axis.
#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "study/identify/break_away.h"
#include "study/procedures/believed_model.h"
#include "study/procedures/procedures.h"
#include "study/procedures/settings.h"
#include "study/statistics/statistics.h"

namespace towbench::study::procedures {
namespace {

struct BreakAwayMapSettings {
  int repeats = 628;
  double increment_pct = 0.1;
  double step_s = 0.3;
  double threshold_m_per_s = 8e-3;
  double start_share = 0.12;
  int bins = 8;

  template <typename Visitor>
  void visit(Visitor& v) {
    v.value("repeats", repeats, core::between(8, 5000), "how often the axis breaks away");
    v.value("increment_pct", increment_pct, core::between(0.01, 1), "duty added at each step");
    v.value("step_s", step_s, core::between(0.01, 2), "time of a step");
    v.value("threshold_m_per_s", threshold_m_per_s, core::between(1e-5, 0.05),
            "faster than this is motion");
    v.value("start_share", start_share, core::between(0.05, 0.9), "of the track, where it starts");
    v.value("bins", bins, core::between(1, 60), "of the map");
  }
};

constexpr int kRepeatsATalk = 40;
constexpr double kSwingHelps = 0.1;  // of a step, as was seen

class BreakAwayMap final : public Procedure {
 public:
  [[nodiscard]] std::string_view id() const noexcept override { return "EXP-OL-1"; }
  [[nodiscard]] std::string_view title() const noexcept override { return "Break-away map"; }
  void check_settings(const std::filesystem::path& file) const override {
    static_cast<void>(read_settings<BreakAwayMapSettings>(file, core::Axis::kY));
  }

  [[nodiscard]] ProcedureOutcome run(const ProcedureContext& context) const override {
    const auto settings = read_settings<BreakAwayMapSettings>(context.settings, context.axis);
    const auto& belief = context.machine.configuration().axes[context.axis];
    const auto scale = torque_scale(context);
    // Half as much again as ever believed: friction of a machine nobody has studied.
    const double limit_pct =
        std::ceil(2 * belief.plausibility.worst_breakaway_Nm / scale.torque_per_duty_Nm);
    if (limit_pct > 50) {
      return ProcedureOutcome::refused(
          fmt::format("stall: break-away may take {:.0f} % duty, 50 % are allowed", limit_pct));
    }
    const auto track = track_of(belief);
    double place_m = track.min_m + settings.start_share * track.length_m();
    std::vector<identify::BreakAway> all;
    while (static_cast<int>(all.size()) < settings.repeats) {
      if (place_m > track.max_m - 0.05 * track.length_m()) {
        return ProcedureOutcome::failed("the axis ran out of travel");
      }
      const int wanted = std::min(kRepeatsATalk, settings.repeats - static_cast<int>(all.size()));
      const auto data = play(context, settings, place_m, limit_pct, wanted, all.size());
      if (!data.trouble.empty()) {
        return ProcedureOutcome::failed(data.trouble);
      }
      const auto found = identify::find_break_aways(data, context.axis, settings.threshold_m_per_s);
      if (static_cast<int>(found.size()) < wanted) {
        return ProcedureOutcome::failed(
            fmt::format("{} of {} ramps to {} % broke away", found.size(), wanted, limit_pct));
      }
      all.insert(all.end(), found.begin(), found.end());
      place_m = data.position_m(context.axis, data.rows() - 1);
      context.tell(static_cast<double>(all.size()) / settings.repeats);
    }
    return judged(context, settings, all, scale);
  }

 private:
  static identify::Recording play(const ProcedureContext& context,
                                  const BreakAwayMapSettings& settings, double place_m,
                                  double limit_pct, int repeats, std::size_t done) {
    Conversation talk{.name = fmt::format("EXP-OL-1-{}-{}", core::name_of(context.axis), done)};
    talk.start_m = middle_of_tracks(context.machine);
    talk.start_m[context.axis] = place_m;
    talk.keeps_idle_rows = false;
    talk.steps = declare_position(talk, context.machine);
    const auto text =
        fmt::format("rmpi break {} --increment {}% --step {}s --stop-speed {}m/s --limit {}%",
                    core::name_of(context.axis), settings.increment_pct, settings.step_s,
                    settings.threshold_m_per_s, limit_pct);
    const double longest_s = limit_pct / settings.increment_pct * settings.step_s + 5;
    for (int i = 0; i < repeats; ++i) {
      talk.steps.push_back(move(text, longest_s));
    }
    talk.limit_s = longest_s * repeats + 10;
    return context.machine.play(talk, studied_configuration(context));
  }

  static ProcedureOutcome judged(const ProcedureContext& context,
                                 const BreakAwayMapSettings& settings,
                                 const std::vector<identify::BreakAway>& all,
                                 const TorqueScale& scale) {
    const auto [low, high] = std::minmax_element(
        all.begin(), all.end(),
        [](const auto& a, const auto& b) { return a.position_m < b.position_m; });
    const double from = low->position_m;
    const double width = (high->position_m - from) / settings.bins;
    ProcedureOutcome outcome;
    Curve each{.name = "each", .mark = Mark::kDots};
    Curve map{.name = "mean of a stretch, 95 %"};
    double mean = 0;
    for (const auto& one : all) {
      each.x.push_back(one.position_m);
      each.y.push_back(1e3 * one.duty_pct * scale.torque_per_duty_Nm);
      mean += one.duty_pct * scale.torque_per_duty_Nm / static_cast<double>(all.size());
    }
    for (int bin = 0; bin < settings.bins; ++bin) {
      double n = 0;
      double sum = 0;
      double square = 0;
      double place = 0;
      double step = 0;
      for (const auto& one : all) {
        const int of =
            std::min(settings.bins - 1, static_cast<int>((one.position_m - from) / width));
        if (of == bin) {
          const double torque = one.duty_pct * scale.torque_per_duty_Nm;
          n += 1;
          sum += torque;
          square += torque * torque;
          place += one.position_m;
          step = std::max(step, one.step_pct * scale.torque_per_duty_Nm);
        }
      }
      if (n < 4) {
        continue;
      }
      const double spread = std::sqrt(std::max(0.0, square / n - sum / n * sum / n) / (n - 1));
      // Anywhere between two levels, or up to a tenth of a step above them, for the transmission's
      // swing helps; and every ramp of a stretch misses it alike: the middle 95 % of an even
      // spread.
      const double bracket = (1 + kSwingHelps) * step;
      const double value = sum / n + 0.5 * kSwingHelps * step;
      const double resolution = 0.5 * 0.95 * bracket / statistics::kNormal95;
      outcome.estimates.push_back(identify::with_standard_error(
          {.quantity = "breakaway_Nm",
           .axis = std::string(core::name_of(context.axis)),
           .value = value,
           .unit = "N m",
           .rests_on = fmt::format("{:.0f} ramps of {} % each {} s; torque by {}", n,
                                   settings.increment_pct, settings.step_s,
                                   scale.measured ? "EXP-P-1" : "the believed K_T K_amp"),
           .procedure = "EXP-OL-1",
           .at = place / n},
          std::hypot(std::hypot(spread, resolution), value * scale.relative_standard_error)));
      const auto& e = outcome.estimates.back();
      map.x.push_back(place / n);
      map.y.push_back(1e3 * value);
      map.low.push_back(1e3 * e.low);
      map.high.push_back(1e3 * e.high);
    }
    outcome.tables.push_back(
        {.title = "Break-away",
         .head = {"repeats", "over, m", "mean, N m", "thesis (7.2), Y, N m"},
         .rows = {{fmt::format("{}", all.size()), fmt::format("{:.3f}", width * settings.bins),
                   fmt::format("{:.3e}", mean), "3.7e-3 (628 over 0.52 m)"}}});
    outcome.figures.push_back({.title = "Break-away torque along the axis",
                               .x_label = "position, m",
                               .y_label = "torque, mN m",
                               .curves = {std::move(each), std::move(map)},
                               .caption = "Compare Fig. 7.3."});
    return outcome;
  }
};

}  // namespace

std::unique_ptr<Procedure> break_away_map() {
  return std::make_unique<BreakAwayMap>();
}

}  // namespace towbench::study::procedures
