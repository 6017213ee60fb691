#include "harness/report/histogram.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>

#include <fmt/format.h>

#include "harness/report/html.h"
#include "harness/report/quantity.h"

namespace towbench::harness::report {
namespace {

constexpr int kBinsPerDecade = 10;
constexpr double kWidth = 720;
constexpr double kHeight = 150;
constexpr double kBaseline = 120;
constexpr double kTop = 10;

struct Bins {
  int first_decade = 0;
  int decades = 1;
  std::vector<std::size_t> counts;
};

Bins binned(const std::vector<double>& positive) {
  const auto [low, high] = std::minmax_element(positive.begin(), positive.end());
  Bins bins;
  bins.first_decade = static_cast<int>(std::floor(std::log10(*low)));
  bins.decades = std::max(1, static_cast<int>(std::ceil(std::log10(*high))) - bins.first_decade);
  bins.counts.resize(static_cast<std::size_t>(bins.decades * kBinsPerDecade));
  for (const double value : positive) {
    const double place = (std::log10(value) - bins.first_decade) * kBinsPerDecade;
    const auto last = static_cast<double>(bins.counts.size() - 1);
    ++bins.counts[static_cast<std::size_t>(std::clamp(std::floor(place), 0.0, last))];
  }
  return bins;
}

std::string label(double x, double y, const char* anchor, const std::string& text) {
  return fmt::format("<text x=\"{:.1f}\" y=\"{:.1f}\" text-anchor=\"{}\">{}</text>", x, y, anchor,
                     escaped(text));
}

}  // namespace

Distribution distribution_of(std::vector<double> values) {
  std::erase_if(values, [](double value) { return !std::isfinite(value); });
  Distribution d;
  d.samples = values.size();
  if (values.empty()) {
    return d;
  }
  std::sort(values.begin(), values.end());
  const auto rank = [&values](double share) {
    const double n = std::ceil(share * static_cast<double>(values.size()));
    return values[static_cast<std::size_t>(std::max(n, 1.0)) - 1];
  };
  d.min = values.front();
  d.mean = std::accumulate(values.begin(), values.end(), 0.0) / static_cast<double>(d.samples);
  d.p50 = rank(0.5);
  d.p99 = rank(0.99);
  d.p99_9 = rank(0.999);
  d.max = values.back();
  return d;
}

std::string histogram_svg(const std::vector<double>& values, const std::string& unit) {
  std::vector<double> positive;
  for (const double value : values) {
    if (std::isfinite(value) && value > 0) {
      positive.push_back(value);
    }
  }
  if (positive.empty()) {
    return {};
  }
  const Bins bins = binned(positive);
  const std::size_t most = *std::max_element(bins.counts.begin(), bins.counts.end());
  const double log_most = std::log10(static_cast<double>(most) + 1);
  const double bin_width = kWidth / static_cast<double>(bins.counts.size());
  std::string svg = fmt::format(
      "<svg class=\"histogram\" viewBox=\"-8 0 {:.0f} {:.0f}\" role=\"img\" aria-label=\"Histogram "
      "of {} values, logarithmic on both axes\">",
      kWidth + 16, kHeight, positive.size());
  for (std::size_t i = 0; i < bins.counts.size(); ++i) {
    if (bins.counts[i] > 0) {
      const double height =
          std::log10(static_cast<double>(bins.counts[i]) + 1) / log_most * (kBaseline - kTop);
      svg += fmt::format(
          "<rect x=\"{:.1f}\" y=\"{:.1f}\" width=\"{:.1f}\" "
          "height=\"{:.1f}\"><title>{}</title></rect>",
          static_cast<double>(i) * bin_width, kBaseline - height, std::max(bin_width - 1, 1.0),
          height, bins.counts[i]);
    }
  }
  for (int decade = 0; decade <= bins.decades; ++decade) {
    const double x = kWidth * decade / bins.decades;
    const char* anchor = decade == 0 ? "start" : decade == bins.decades ? "end" : "middle";
    svg += fmt::format("<line x1=\"{0:.1f}\" x2=\"{0:.1f}\" y1=\"{1}\" y2=\"{2}\"/>", x, kBaseline,
                       kBaseline + 5);
    svg += label(x, kBaseline + 20, anchor,
                 fmt::format("{}\u00a0{}",
                             readable_number(std::pow(10.0, bins.first_decade + decade)), unit));
  }
  return svg + "</svg>\n";
}

}  // namespace towbench::harness::report
