// Force against speed: what a towing tank is built for. One mark is the mean over a tenth of a
// second in which the axis followed its reference.
#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "bbmc/system/telemetry_row.h"
#include "harness/report/html.h"
#include "harness/report/quantity.h"
#include "harness/report/sections.h"

namespace towbench::harness::report {
namespace {

constexpr double kForceBlock_s = 0.1;
constexpr double kForceWidth = 720;
constexpr double kForceHeight = 260;
constexpr double kForceLeft = 60;
constexpr double kForceBottom = 30;
constexpr auto kForceCounts = static_cast<double>(bbmc::AxisMode::kPosition);

struct ForcePoint {
  double speed_m_per_s = 0;
  double force_N = 0;
};

struct ForceColumns {
  const std::vector<double>& time_s;
  const std::vector<double>& state;
  const std::vector<double>& speed_m_per_s;
  const std::vector<double>& force_N;

  [[nodiscard]] bool counts(std::size_t row) const {
    return state[row] == kForceCounts && std::isfinite(speed_m_per_s[row]) &&
           std::isfinite(force_N[row]);
  }
};

// Blocks begin anew where the axis stops following.
std::vector<ForcePoint> force_means(const ForceColumns& columns) {
  std::vector<ForcePoint> points;
  std::size_t row = 0;
  while (row < columns.time_s.size()) {
    const double end_s = columns.time_s[row] + kForceBlock_s;
    ForcePoint sum;
    std::size_t rows = 0;
    for (; row < columns.time_s.size() && columns.time_s[row] < end_s && columns.counts(row);
         ++row, ++rows) {
      sum.speed_m_per_s += columns.speed_m_per_s[row];
      sum.force_N += columns.force_N[row];
    }
    if (rows == 0) {
      ++row;
      continue;
    }
    const auto n = static_cast<double>(rows);
    if (row < columns.time_s.size() && columns.time_s[row] >= end_s) {
      points.push_back({sum.speed_m_per_s / n, sum.force_N / n});
    }
  }
  return points;
}

struct ForceScale {
  double low = 0;
  double high = 0;

  [[nodiscard]] double share(double value) const { return (value - low) / (high - low); }
};

ForceScale force_scale(const std::vector<ForcePoint>& points, double ForcePoint::*member) {
  ForceScale scale;  // zero belongs to it
  for (const auto& point : points) {
    scale.low = std::min(scale.low, point.*member);
    scale.high = std::max(scale.high, point.*member);
  }
  if (scale.low == scale.high) {
    scale.high += 1;
  }
  return scale;
}

std::string force_label(double x, double y, const char* anchor, const std::string& text) {
  return fmt::format("<text x=\"{:.1f}\" y=\"{:.1f}\" text-anchor=\"{}\">{}</text>", x, y, anchor,
                     escaped(text));
}

std::string force_svg(const std::vector<ForcePoint>& points) {
  const ForceScale across = force_scale(points, &ForcePoint::speed_m_per_s);
  const ForceScale up = force_scale(points, &ForcePoint::force_N);
  const auto x = [&](double speed) {
    return kForceLeft + across.share(speed) * (kForceWidth - kForceLeft - 10);
  };
  const auto y = [&](double force) {
    return kForceHeight - kForceBottom - up.share(force) * (kForceHeight - kForceBottom - 15);
  };
  auto text = fmt::format(
      "<svg class=\"histogram\" viewBox=\"0 0 {:.0f} {:.0f}\" role=\"img\" "
      "aria-label=\"Force against speed\"><g fill=\"none\" stroke=\"currentColor\" "
      "stroke-opacity=\"0.4\"><path d=\"M{:.1f} {:.1f}H{:.1f}M{:.1f} {:.1f}V{:.1f}\"/></g>"
      "<g fill=\"currentColor\" font-size=\"11\">",
      kForceWidth, kForceHeight, x(across.low), y(0), x(across.high), x(0), y(up.low), y(up.high));
  for (const double end : {across.low, across.high}) {
    text += force_label(x(end), kForceHeight - 12, "middle", readable_quantity(end, "m/s"));
  }
  for (const double end : {up.low, up.high}) {
    text += force_label(kForceLeft - 6, y(end) + 4, "end", readable_quantity(end, "N"));
  }
  text += "</g><g fill=\"currentColor\" fill-opacity=\"0.6\">";
  for (const auto& point : points) {
    text += fmt::format("<circle cx=\"{:.1f}\" cy=\"{:.1f}\" r=\"2\"/>", x(point.speed_m_per_s),
                        y(point.force_N));
  }
  return text + "</g></svg>";
}

std::string force_figure(const PlotTable& table, core::Axis axis) {
  const auto name = [axis](const char* quantity) {
    return fmt::format("{}_{}", core::name_of(axis), quantity);
  };
  const auto* state = table.find(name("state"));
  const auto* speed = table.find(name("velocity_m_per_s"));
  const auto* force = table.find(fmt::format("force_{}_N", core::name_of(axis)));
  if (state == nullptr || speed == nullptr || force == nullptr) {
    return {};
  }
  const auto points = force_means({table.columns[0].values, *state, *speed, *force});
  return points.empty()
             ? std::string{}
             : fmt::format(
                   "<figure class=\"timing\"><figcaption>Force along {0} against the speed "
                   "of {0}, {1} means</figcaption>{2}</figure>\n",
                   core::name_of(axis), points.size(), force_svg(points));
}

}  // namespace

std::string force_section(const PlotTable& table, int level) {
  std::string figures;
  for (const auto axis : core::kAllAxes) {
    figures += table.columns.empty() ? std::string{} : force_figure(table, axis);
  }
  if (figures.empty()) {
    return {};
  }
  return "<section class=\"force\">\n" + heading(level, "Force against speed") +
         "<p class=\"note\">The force sensor's reading, means over 0.1 s of a followed reference, "
         "against the controller's own speed.</p>\n" +
         figures + "</section>\n";
}

}  // namespace towbench::harness::report
