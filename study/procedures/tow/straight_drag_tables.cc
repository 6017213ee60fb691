#include "study/procedures/tow/straight_drag_tables.h"

#include <algorithm>
#include <array>
#include <cmath>

#include <fmt/format.h>

#include "study/identify/tow/steady_span.h"
#include "study/procedures/tow/tracking_errors.h"

namespace towbench::study::procedures {

using core::Axis;

namespace {

std::string interval_of(const identify::Estimate& e) {
  return e.no_interval.empty() ? fmt::format("{:.3f} .. {:.3f}", e.low, e.high) : "withheld";
}

}  // namespace

identify::Estimate scale_estimate(const identify::DriveScale& scale, const Machine& machine) {
  const auto& believed = machine.configuration().axes[Axis::kY].drive;
  const double table_7_1 =
      believed.full_duty_torque_Nm() / machine.nameplate(Axis::kY).metres_per_motor_rad() / 100.0;
  return identify::to_estimate(
      {scale.force_per_duty_N, scale.standard_error_N, scale.degrees_of_freedom},
      "force_per_duty_N_per_pct", "y", "N/%",
      fmt::format(
          "a known weight over a pulley, weighed by the force sensor; Table 7.1 gives {:.4f}",
          table_7_1));
}

Curve curve_of(const std::string& name, std::span<const identify::DragPoint> points) {
  Curve curve{.name = name, .mark = Mark::kDots};
  for (const auto& point : points) {
    const double half =
        identify::student_factor(point.force_N.degrees_of_freedom) * point.force_N.standard_error;
    curve.x.push_back(point.speed_m_per_s);
    curve.y.push_back(point.force_N.value);
    curve.low.push_back(point.force_N.value - half);
    curve.high.push_back(point.force_N.value + half);
  }
  return curve;
}

Figure friction_figure(const identify::RigidModel& near, const identify::RigidModel& middle,
                       const identify::ExtendedModel& extended) {
  Figure figure{.title = "Dry friction by place",
                .x_label = "place, m",
                .y_label = "friction at the carriage, N",
                .caption = "Compare Figs 7.13 and 8.1: the load rises towards mid tank."};
  figure.curves.push_back(
      {.name = "extended model", .x = extended.places_m(), .y = extended.levels_N()});
  for (const auto& [name, model] : {std::pair{"rigid, identified at the near end", &near},
                                    std::pair{"rigid, identified in mid tank", &middle}}) {
    Curve level{.name = name};
    for (const auto& stretch : model->stretches) {
      level.x.push_back(std::min(stretch.from_m, stretch.to_m));
      level.x.push_back(std::max(stretch.from_m, stretch.to_m));
    }
    const auto [low, high] = std::minmax_element(level.x.begin(), level.x.end());
    level.x = {*low, *high};
    level.y = {model->coulomb_N, model->coulomb_N};
    figure.curves.push_back(std::move(level));
  }
  return figure;
}

ResultTable model_table(const identify::RigidModel& near, const identify::RigidModel& middle,
                        const Machine& machine) {
  const double r = machine.nameplate(Axis::kY).metres_per_motor_rad();
  ResultTable table{
      .title = "Table 8.2: rigid, position-blind model (8.2) of Y",
      .head = {"quantity", "thesis", "identified at the near end", "identified in mid tank"}};
  const auto row = [&](const char* name, const char* thesis, double a, double b) {
    table.rows.push_back({name, thesis, fmt::format("{:.4g}", a), fmt::format("{:.4g}", b)});
  };
  row("J_eff, kg m2", "1.502e-5", near.mass_kg * r * r, middle.mass_kg * r * r);
  row("B_eff, N m s/rad", "4.657e-6", near.viscous_N_s_per_m * r * r,
      middle.viscous_N_s_per_m * r * r);
  row("C_eff, N m", "3.9e-3", near.coulomb_N * r, middle.coulomb_N * r);
  return table;
}

ResultTable tracking_table(const std::vector<identify::Recording>& out,
                           const std::vector<identify::Recording>& in) {
  // Table 8.3, mean position error in mm and mean velocity error.
  constexpr std::array<std::array<double, 3>, 6> kThesis{{{0.050, 0.336, 1.69e-2},
                                                          {0.150, 0.581, 6.9e-2},
                                                          {0.250, 0.817, 9.87e-2},
                                                          {0.350, 1.8, 3.8e-2},
                                                          {0.450, 1.9, 1.63e-2},
                                                          {0.550, 3.9, 2.31e-2}}};
  ResultTable table{.title = "Table 8.3: fast trapezoids, motor side, whole profile, mm",
                    .head = {"mm/s", "thesis, mean", "air: |mean|", "RMS", "peak", "water: |mean|",
                             "RMS", "peak", "peak below the thesis's mean"}};
  for (std::size_t k = 0; k < out.size() && k < in.size(); ++k) {
    const auto spans = identify::steady_spans(in[k], Axis::kY, 0.0);
    const double speed = spans.empty() ? 0.0 : std::fabs(spans[0].speed_m_per_s);
    const auto air = tracking_errors(out[k], Axis::kY);
    const auto water = tracking_errors(in[k], Axis::kY);
    const auto* thesis = std::find_if(kThesis.begin(), kThesis.end(), [&](const auto& each) {
      return std::fabs(each[0] - speed) < 0.005;
    });
    const auto mm = [](double metres) { return fmt::format("{:.4f}", 1e3 * metres); };
    const bool known = thesis != kThesis.end();
    const double worst_mm = 1e3 * std::max(air.peak_m, water.peak_m);
    table.rows.push_back({fmt::format("{:.0f}", 1e3 * speed),
                          known ? fmt::format("{:.3f}", (*thesis)[1]) : "-",
                          mm(std::fabs(air.mean_m)), mm(air.rms_m), mm(air.peak_m),
                          mm(std::fabs(water.mean_m)), mm(water.rms_m), mm(water.peak_m),
                          !known                    ? "-"
                          : worst_mm < (*thesis)[1] ? "yes"
                                                    : "NO"});
  }
  return table;
}

ResultTable drag_table(const identify::Estimates& estimates) {
  ResultTable table{.title = "Table 8.4: drag coefficient, N s2/m2",
                    .head = {"method", "thesis (exponent corrected)", "bench", "95 %"}};
  for (const auto& [quantity, name, thesis] :
       {std::tuple{"fsm", "force sensor (FSM)", "8.78"},
        std::tuple{"mcd", "motor current difference (MCD)", "8.39"},
        std::tuple{"mbdp_middle", "MBDP, rigid model of mid tank", "7.97"},
        std::tuple{"mbdp_near", "MBDP, rigid model of the near end", "-"},
        std::tuple{"mbdp", "MBDP, friction by place", "-"}}) {
    const auto* found = identify::find(estimates, std::string(quantity) + "_drag_N_s2_per_m2", "y");
    if (found != nullptr) {
      table.rows.push_back(
          {name, thesis, fmt::format("{:.3f}", found->value), interval_of(*found)});
    }
  }
  return table;
}

}  // namespace towbench::study::procedures
