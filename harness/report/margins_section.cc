#include <algorithm>
#include <array>
#include <cmath>
#include <optional>

#include <fmt/format.h>

#include "harness/report/html.h"
#include "harness/report/quantity.h"
#include "harness/report/sections.h"

namespace towbench::harness::report {
namespace {

using Json = nlohmann::json;

constexpr double kPictureWidth = 800;
constexpr double kPictureHeight = 120;
constexpr std::size_t kMostPoints = 800;

struct Range {
  double from = 0;
  double to = 1;
  [[nodiscard]] double at(double value, double length) const {
    return (value - from) / (to - from) * length;
  }
};

struct Curve {
  const std::vector<double>& time_s;
  const std::vector<double>& margin;
  Range across;
  Range up;

  [[nodiscard]] std::string point(double time, double value) const {
    return fmt::format("{:.1f},{:.1f}", across.at(time, kPictureWidth),
                       kPictureHeight - up.at(value, kPictureHeight));
  }
};

// Zero, where the requirement breaks, is always on the scale.
std::optional<Curve> curve_of(const std::vector<double>& time_s,
                              const std::vector<double>& margin) {
  Range up{0, 0};
  for (const double value : margin) {
    if (std::isfinite(value)) {
      up = {std::min(up.from, value), std::max(up.to, value)};
    }
  }
  const bool is_flat = up.to <= up.from;
  up = is_flat ? Range{-1, 1} : Range{up.from - 0.05 * (up.to - up.from), up.to};
  if (time_s.size() < 2 || !(time_s.back() > time_s.front())) {
    return std::nullopt;
  }
  return Curve{time_s, margin, {time_s.front(), time_s.back()}, up};
}

// Of each stretch of samples the smallest margin; a gap where nothing was demanded.
std::string margin_lines(const Curve& curve) {
  const std::size_t width = curve.margin.size() / kMostPoints + 1;
  std::string html;
  std::string points;
  const auto end_line = [&] {
    if (!points.empty()) {
      html += "<polyline class=\"margin\" points=\"" + points + "\"/>";
      points.clear();
    }
  };
  for (std::size_t begin = 0; begin < curve.margin.size(); begin += width) {
    std::optional<std::size_t> least;
    for (std::size_t i = begin; i < std::min(begin + width, curve.margin.size()); ++i) {
      const bool is = std::isfinite(curve.margin[i]);
      least = is && (!least || curve.margin[i] < curve.margin[*least]) ? i : least;
    }
    if (!least) {
      end_line();
      continue;
    }
    points += (points.empty() ? "" : " ") + curve.point(curve.time_s[*least], curve.margin[*least]);
  }
  end_line();
  return html;
}

std::string margin_figure(const Curve& curve, const Json& check) {
  const auto value = number_at(check, "value");
  const auto unit = text_at(check, "unit");
  const auto worst = std::find(curve.margin.begin(), curve.margin.end(), value.value_or(NAN));
  std::string mark;
  std::string words = value ? "margin " + readable_quantity(*value, unit) : "no margin";
  if (value && worst != curve.margin.end()) {
    const double time_s = curve.time_s[static_cast<std::size_t>(worst - curve.margin.begin())];
    mark = fmt::format("<circle cx=\"{:.1f}\" cy=\"{:.1f}\" r=\"5\"/>",
                       curve.across.at(time_s, kPictureWidth),
                       kPictureHeight - curve.up.at(*value, kPictureHeight));
    words += fmt::format(", worst at {:.4f}\u00a0s", time_s);
  }
  const double zero = kPictureHeight - curve.up.at(0, kPictureHeight);
  return fmt::format(
      "<figure class=\"margin\"><figcaption><strong>{0}</strong>: {1}; {2}</figcaption>\n"
      "<svg viewBox=\"-8 -8 {3} {4}\" role=\"img\" aria-label=\"margin of {0} over time: {2}\">"
      "<line class=\"zero\" x1=\"0\" x2=\"{5}\" y1=\"{6:.1f}\" y2=\"{6:.1f}\"/>{7}{8}</svg>\n"
      "<p class=\"meaning\">{9:.4g} to {10:.4g}\u00a0s; from {11} to {12}; the dashed line is "
      "0</p></figure>\n",
      escaped(text_at(check, "name")), escaped(text_at(check, "meaning")), escaped(words),
      kPictureWidth + 16, kPictureHeight + 16, kPictureWidth, zero, margin_lines(curve), mark,
      curve.across.from, curve.across.to, escaped(readable_quantity(curve.up.from, unit)),
      escaped(readable_quantity(curve.up.to, unit)));
}

}  // namespace

std::string margins_section(const RunContents& run, int level) {
  const Json& checks = member(run.result, "checks");
  const auto* time_s = run.margins ? run.margins->find("time_s") : nullptr;
  if (!run.contradictions.empty() || !checks.is_array() || time_s == nullptr) {
    return {};
  }
  std::string figures;
  for (const Json& check : checks) {
    const auto* margin = run.margins->find(text_at(check, "name"));
    if (margin != nullptr && margin != time_s) {
      const auto curve = curve_of(*time_s, *margin);
      figures += curve ? margin_figure(*curve, check) : std::string{};
    }
  }
  return figures.empty()
             ? std::string{}
             : "<section class=\"margins\">\n" +
                   heading(level, "Margins of requirements over time") + figures + "</section>\n";
}

}  // namespace towbench::harness::report
