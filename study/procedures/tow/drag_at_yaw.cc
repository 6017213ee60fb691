// EXP-3: a body at a yaw angle to its motion: drag and side force against the angle.
#include <fmt/format.h>

#include "study/identify/tow/paired_difference.h"
#include "study/identify/tow/yaw_drag.h"
#include "study/procedures/settings.h"
#include "study/procedures/tow/feasibility.h"
#include "study/procedures/tow/straight_tow.h"
#include "study/procedures/tow/tow_procedure.h"

namespace towbench::study::procedures {
namespace {

using core::Axis;

struct Exp3Settings {
  StraightTowSettings tows{0.25, 0.40};
  core::BoundedVector<double, 32> yaw_deg;

  Exp3Settings() noexcept {
    for (const double yaw : {0.0, 15.0, 30.0, 45.0, 60.0, 90.0}) {
      (void)yaw_deg.push_back(yaw);
    }
  }

  template <typename Visitor>
  void visit(Visitor& v) {
    v.group("tows", tows, "at each angle");
    v.list("yaw_deg", yaw_deg, core::between(-180.0, 180.0), "the body is turned to these");
  }
};

std::optional<identify::YawPoint> point_at(double yaw_deg,
                                           const std::vector<identify::Recording>& in,
                                           const std::vector<identify::Recording>& out,
                                           double settle_s) {
  std::vector<identify::DragPoint> along;
  std::vector<identify::DragPoint> side;
  for (std::size_t k = 0; k < in.size(); ++k) {
    const auto y = identify::paired_difference(in[k], in[k].force_N[Axis::kY], out[k],
                                               out[k].force_N[Axis::kY], Axis::kY, -1.0, settle_s);
    // To the right of +Y is +X; a positive angle pushes to the left, towards -X.
    const auto x = identify::paired_difference(in[k], in[k].force_N[Axis::kX], out[k],
                                               out[k].force_N[Axis::kX], Axis::kY, -1.0, settle_s);
    if (!y || !x) {
      return std::nullopt;
    }
    along.push_back(*y);
    side.push_back(*x);
  }
  return identify::YawPoint{yaw_deg, identify::quadratic_drag(along),
                            identify::quadratic_drag(side)};
}

// Of all angles, by the runs that they share.
std::optional<identify::CommonDoubt> common_doubt(const std::vector<identify::Recording>& out,
                                                  double settle_s) {
  core::PerPlanarAxis<std::vector<identify::DragPoint>> points;
  for (const auto& run : out) {
    for (const auto axis : core::kPlanarAxes) {
      const auto point = identify::both_ways(run, run.force_N[axis], Axis::kY, -1.0, settle_s);
      if (!point) {
        return std::nullopt;
      }
      points[axis].push_back(*point);
    }
  }
  return identify::CommonDoubt{identify::quadratic_drag(points[Axis::kY]).standard_error,
                               identify::quadratic_drag(points[Axis::kX]).standard_error};
}

TowOutcome told(const std::vector<identify::YawPoint>& points, const identify::YawDrag& law) {
  const std::string by_sensor = "force sensor in the water less out of it, both ways";
  const std::string by_law = "cos^2 and sin^2 law through both forces at all angles";
  TowOutcome outcome;
  ResultTable table{.title = "Drag against yaw, N s2/m2",
                    .head = {"yaw, deg", "along the motion", "law", "sideways"}};
  Curve measured{.name = "along the motion", .mark = Mark::kDots};
  Curve sideways{.name = "sideways", .mark = Mark::kDots};
  Curve fitted{.name = "law"};
  for (const auto& point : points) {
    outcome.estimates.push_back(
        identify::to_estimate(point.along, "yaw_drag_N_s2_per_m2", "y", "N s2/m2", by_sensor));
    outcome.estimates.back().at = point.yaw_deg;
    table.rows.push_back({fmt::format("{:.0f}", point.yaw_deg),
                          fmt::format("{:.3f}", point.along.value),
                          fmt::format("{:.3f}", law.along_at(point.yaw_deg)),
                          fmt::format("{:.3f}", point.side.value)});
    measured.x.push_back(point.yaw_deg);
    measured.y.push_back(point.along.value);
    sideways.x.push_back(point.yaw_deg);
    sideways.y.push_back(point.side.value);
    fitted.x.push_back(point.yaw_deg);
    fitted.y.push_back(law.along_at(point.yaw_deg));
  }
  outcome.estimates.push_back(
      identify::to_estimate(law.along_axis, "body_drag_N_s2_per_m2", "", "N s2/m2", by_law));
  outcome.estimates.push_back(
      identify::to_estimate(law.ratio, "across_drag_ratio", "", "1", by_law));
  outcome.figures = {{.title = "Drag against yaw",
                      .x_label = "yaw, deg",
                      .y_label = "N s2/m2",
                      .curves = {std::move(measured), std::move(sideways), std::move(fitted)},
                      .caption = {}}};
  outcome.tables = {std::move(table)};
  return outcome;
}

class DragAtYaw final : public TowProcedure {
 public:
  [[nodiscard]] std::string_view id() const noexcept override { return "EXP-3"; }
  [[nodiscard]] std::string_view title() const noexcept override {
    return "drag of a body at a yaw angle";
  }
  void check_settings(const std::filesystem::path& file) const override {
    static_cast<void>(read_settings<Exp3Settings>(file, Axis::kY));
  }
  [[nodiscard]] Load load() const override { return {.rig = "tow-body-at-yaw"}; }

  [[nodiscard]] TowOutcome run(const TowContext& context) const override {
    const auto s = read_settings<Exp3Settings>(context.settings, Axis::kY);
    const auto dry = context.loads.with({});
    for (auto why :
         {no_force_sensor(dry), not_in_water(context.loads, load()), why_not(dry, s.tows)}) {
      if (!why.empty()) {
        return tow_refused(why);
      }
    }
    double simulated_s = 0;
    const auto out = tow(dry, "out of the water", s.tows);
    if (!out.trouble.empty()) {
      return tow_failed(out.trouble);
    }
    std::vector<identify::YawPoint> points;
    for (const double yaw : s.yaw_deg) {
      auto turned = load();
      turned.yaw_deg = yaw;
      const auto wet = context.loads.with(turned);
      const auto in = tow(wet, fmt::format("at {:.1f} deg", yaw), s.tows);
      const auto point = in.trouble.empty()
                             ? point_at(yaw, in.recordings, out.recordings, s.tows.settle_s)
                             : std::nullopt;
      if (!point) {
        return tow_failed(in.trouble.empty() ? "a tow has no steady part both ways" : in.trouble);
      }
      points.push_back(*point);
      simulated_s += wet.simulated_s();
      context.tell(static_cast<double>(points.size()) / static_cast<double>(s.yaw_deg.size()));
    }
    const auto common = common_doubt(out.recordings, s.tows.settle_s);
    const auto law = common ? identify::yaw_drag(points, *common) : std::nullopt;
    if (!law) {
      return tow_failed("the angles do not tell drag along and across the body apart");
    }
    auto outcome = told(points, *law);
    outcome.simulated_s = simulated_s + dry.simulated_s();
    return outcome;
  }
};

}  // namespace

std::unique_ptr<TowProcedure> drag_at_yaw() {
  return std::make_unique<DragAtYaw>();
}

}  // namespace towbench::study::procedures
