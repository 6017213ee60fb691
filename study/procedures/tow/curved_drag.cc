// EXP-2: drag along a curved path, by both axes' force sensor and motor current difference.
#include <cmath>
#include <numbers>

#include <fmt/format.h>

#include "study/identify/tow/curved_tow.h"
#include "study/procedures/settings.h"
#include "study/procedures/tow/feasibility.h"
#include "study/procedures/tow/tow_procedure.h"
#include "study/procedures/tow/weigh_drive.h"

namespace towbench::study::procedures {
namespace {

using core::Axis;

struct Exp2Settings {
  double radius_m = 0.20;
  double period_s = 4.0;
  double turns = 9;
  double start_y_m = 1.0;
  double start_x_m = 0.3368;
  double slow_share =
      0.35;  // of the path's speed: an axis slower than that is not read by its duty
  WeighSettings weigh;

  template <typename Visitor>
  void visit(Visitor& v) {
    v.value("radius_m", radius_m, core::between(0.01, 0.3), "of the circle");
    v.value("period_s", period_s, core::between(0.5, 100.0), "of a turn");
    v.value("turns", turns, core::between(4.0, 100.0), "how many");
    v.value("start_y_m", start_y_m, core::between(0.0, 10.0), "where the circle begins");
    v.value("start_x_m", start_x_m, core::between(0.0, 10.0), "where the circle begins");
    v.value("slow_share", slow_share, core::between(0.0, 0.7),
            "an axis slower than this share of the path's speed is not read by its duty");
    v.group("weigh", weigh, "the drives' scale by a known weight");
  }
  [[nodiscard]] double speed_m_per_s() const { return 2 * std::numbers::pi * radius_m / period_s; }
};

Conversation circle(const Machine& machine, const std::string& name, const Exp2Settings& s) {
  Conversation talk;
  talk.name = name;
  talk.start_m[Axis::kY] = s.start_y_m;
  talk.start_m[Axis::kX] = s.start_x_m;
  talk.steps = declare_position(talk, machine);
  const double longest_s = (s.turns + 2) * s.period_s + 10;
  talk.steps.push_back(move(fmt::format("run -circle --radius {:.4f}m --period {:.4f}s --turns {}",
                                        s.radius_m, s.period_s, s.turns),
                            longest_s));
  talk.limit_s = longest_s + 10;
  return talk;
}

ResultTable heading_table(const identify::CurvedDrag& drag) {
  ResultTable table{.title = "Drag along the circle, force sensor",
                    .head = {"heading, deg", "against the motion, N", "to its left, N"}};
  for (const auto& each : drag.headings) {
    const double square = drag.speed_m_per_s * drag.speed_m_per_s;
    table.rows.push_back({fmt::format("{:.0f}", each.heading_deg),
                          fmt::format("{:.4f}", square * each.along_N_s2_per_m2.value),
                          fmt::format("{:+.4f}", square * each.across_N_s2_per_m2.value)});
  }
  return table;
}

// No scatter between turns shows what every turn repeats.
constexpr const char* kSwings =
    "the carriage's swing after each reversal is the same in every turn";

TowOutcome told(const identify::CurvedDrag& sensor, const identify::CurvedDrag& drive) {
  TowOutcome outcome;
  const std::string by_sensor =
      "force sensor in the water and out of it, turn by turn, the carriage's own motion behind its "
      "transmission";
  const auto add = [&](const identify::UncertainMean& mean, const char* quantity, const char* axis,
                       const std::string& rests_on) {
    outcome.estimates.push_back(identify::to_estimate(mean, quantity, axis, "N s2/m2", rests_on));
  };
  add(sensor.quadratic_drag_N_s2_per_m2, "curved_fsm_drag_N_s2_per_m2", "", by_sensor);
  for (const auto axis : core::kPlanarAxes) {
    add(sensor.along_axis_N_s2_per_m2[axis], "axis_drag_N_s2_per_m2",
        std::string(core::name_of(axis)).c_str(), by_sensor);
  }
  add(drive.quadratic_drag_N_s2_per_m2, "curved_mcd_drag_N_s2_per_m2", "",
      "duty of both axes in the water less out of it (8.5), away from each axis's reversals, "
      "scaled "
      "by a known weight");
  outcome.estimates.back() = identify::withheld(outcome.estimates.back(), kSwings);
  Curve along{.name = "against the motion", .mark = Mark::kDots};
  Curve across{.name = "to its left", .mark = Mark::kDots};
  for (const auto& each : sensor.headings) {
    add(each.along_N_s2_per_m2, "heading_drag_N_s2_per_m2", "", by_sensor);
    outcome.estimates.back() = identify::withheld(outcome.estimates.back(), kSwings);
    outcome.estimates.back().at = each.heading_deg;
    along.x.push_back(each.heading_deg);
    along.y.push_back(each.along_N_s2_per_m2.value);
    across.x.push_back(each.heading_deg);
    across.y.push_back(each.across_N_s2_per_m2.value);
  }
  outcome.figures = {{.title = "Drag as a vector along the circle",
                      .x_label = "heading, deg from +Y",
                      .y_label = "N s2/m2",
                      .curves = {std::move(along), std::move(across)},
                      .caption = {}}};
  outcome.tables = {heading_table(sensor)};
  return outcome;
}

class CurvedDragTow final : public TowProcedure {
 public:
  [[nodiscard]] std::string_view id() const noexcept override { return "EXP-2"; }
  [[nodiscard]] std::string_view title() const noexcept override {
    return "drag along a curved path";
  }
  void check_settings(const std::filesystem::path& file) const override {
    static_cast<void>(read_settings<Exp2Settings>(file, Axis::kY));
  }
  [[nodiscard]] Load load() const override { return {.rig = "tow-cylinder"}; }

  [[nodiscard]] TowOutcome run(const TowContext& context) const override {
    const auto s = read_settings<Exp2Settings>(context.settings, Axis::kY);
    const auto dry = context.loads.with({});
    const auto wet = context.loads.with(load());
    if (const auto why = why_not_at_all(context, wet, s); !why.empty()) {
      return tow_refused(why);
    }
    core::PerPlanarAxis<double> scale{};
    core::PerPlanarAxis<identify::CarriageTransmission> transmission{};
    for (const auto axis : core::kPlanarAxes) {
      const auto weighed = weigh_drive(dry, axis, s.weigh);
      if (!weighed.trouble.empty()) {
        return tow_failed(weighed.trouble);
      }
      scale[axis] = weighed.scale.force_per_duty_N;
      transmission[axis] = weighed.transmission;
    }
    context.tell(0.5);
    const auto in = wet.play(circle(wet, "circle in the water", s));
    const auto out = dry.play(circle(dry, "circle out of the water", s));
    for (const auto* each : {&in, &out}) {
      if (!each->trouble.empty()) {
        return tow_failed(each->trouble);
      }
    }
    const auto sensor = identify::curved_force(in, out, transmission);
    const auto drive =
        identify::curved_drive(in, out, {.scale = scale, .slow_share = s.slow_share});
    if (!sensor || !drive) {
      return tow_failed("fewer than two whole turns at speed");
    }
    auto outcome = told(*sensor, *drive);
    outcome.simulated_s = dry.simulated_s() + wet.simulated_s();
    return outcome;
  }

 private:
  [[nodiscard]] std::string why_not_at_all(const TowContext& context, const Machine& wet,
                                           const Exp2Settings& s) const {
    const double acceleration = s.speed_m_per_s() * s.speed_m_per_s() / s.radius_m;
    for (auto why : {no_axis(wet, Axis::kY), no_axis(wet, Axis::kX), no_force_sensor(wet),
                     not_in_water(context.loads, load()),
                     too_fast(wet, Axis::kY, s.speed_m_per_s(), acceleration),
                     too_fast(wet, Axis::kX, s.speed_m_per_s(), acceleration),
                     no_travel(wet, Axis::kY, s.start_y_m, s.start_y_m + 2 * s.radius_m),
                     no_travel(wet, Axis::kX, s.start_x_m - s.radius_m, s.start_x_m + s.radius_m),
                     why_not(wet, Axis::kY, s.weigh), why_not(wet, Axis::kX, s.weigh)}) {
      if (!why.empty()) {
        return why;
      }
    }
    return {};
  }
};

}  // namespace

std::unique_ptr<TowProcedure> curved_drag() {
  return std::make_unique<CurvedDragTow>();
}

}  // namespace towbench::study::procedures
