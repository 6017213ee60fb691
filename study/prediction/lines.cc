#include "study/prediction/lines.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace towbench::study::diagnose {
namespace {

using Eigen::Index;
using Eigen::VectorXd;

constexpr Index kMostSamples = 6000;
constexpr std::size_t kMostLines = 3000;
constexpr std::size_t kKept = 2;  // of each kind
constexpr double kPerWay = 3;     // lines looked at in 1 / (way or time)

// The strongest lines of e over x, at multiples of `spacing`; peaks stand apart by two spacings.
std::vector<double> strongest(const VectorXd& x, const VectorXd& e, double spacing,
                              std::size_t count) {
  const Index n = x.size();
  const Index every = std::max<Index>(1, n / kMostSamples);
  std::vector<double> cosine(count, 0);
  std::vector<double> sine(count, 0);
  for (Index i = 0; i < n; i += every) {
    if (e[i] == 0) continue;
    const double angle = 2 * std::numbers::pi * spacing * x[i];
    const double c1 = std::cos(angle);
    const double s1 = std::sin(angle);
    double c = e[i] * c1;
    double s = e[i] * s1;
    for (std::size_t line = 0; line < count; ++line) {
      cosine[line] += c;
      sine[line] += s;
      const double turned = c * c1 - s * s1;
      s = c * s1 + s * c1;
      c = turned;
    }
  }
  std::vector<double> power(count);
  for (std::size_t line = 0; line < count; ++line) {
    power[line] = cosine[line] * cosine[line] + sine[line] * sine[line];
  }
  std::vector<double> out;
  for (std::size_t peak = 0; peak < kKept; ++peak) {
    const auto best = std::max_element(power.begin(), power.end());
    const auto at = static_cast<std::size_t>(best - power.begin());
    out.push_back(spacing * static_cast<double>(at + 1));
    for (std::size_t i = at < 6 ? 0 : at - 6; i < std::min(count, at + 7); ++i) power[i] = 0;
  }
  return out;
}

}  // namespace

void find_lines(const Data& data, const VectorXd& e, Context& c) {
  VectorXd place(data.samples());
  VectorXd time(data.samples());
  for (std::size_t i = 0; i < data.scenes.size(); ++i) {
    const Run& run = *data.scenes[i].run;
    for (Index k = 0; k < run.size(); ++k) {
      place[data.starts[i] + k] = run.position_m[k];
      time[data.starts[i] + k] =
          data.scenes[i].session_start_s + run.period_s * static_cast<double>(k);
    }
  }
  const auto lines_up_to = [](double most, double spacing) {
    return static_cast<std::size_t>(
        std::clamp(most / spacing, 1.0, static_cast<double>(kMostLines)));
  };
  const double per_m = 1 / (kPerWay * c.stroke_m);
  const double finest = c.resolution_m > 0 ? 0.2 / c.resolution_m : 1e4 * per_m;
  const double hertz = 1 / (kPerWay * c.duration_s);
  const std::size_t along = lines_up_to(finest, per_m);
  const std::size_t in_time = lines_up_to(std::min(60.0, 0.2 / c.period_s), hertz);
  c.searched = static_cast<double>(along + in_time);
  c.lines_per_m = strongest(place, e, per_m, along);
  // Slower than once a run is a drift.
  c.lines_Hz = strongest(time, e, hertz, in_time);
  std::erase_if(c.lines_per_m, [&](double f) { return f * c.stroke_m < 2; });
  std::erase_if(c.lines_Hz, [&](double f) { return f * c.duration_s < 4; });
}

}  // namespace towbench::study::diagnose
