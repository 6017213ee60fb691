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
constexpr double kTurn_rad = 2 * std::numbers::pi;
constexpr double kPerWay = 3;  // lines looked at in 1 / (way or time)

// The strongest lines of e over x, at multiples of `spacing`; peaks stand apart by two spacings.
// Each run has a phase of its own.
std::vector<double> strongest(const Data& data, const VectorXd& x, const VectorXd& e,
                              double spacing, std::size_t count) {
  const Index every = std::max<Index>(1, x.size() / kMostSamples);
  std::vector<double> power(count, 0);
  for (std::size_t run = 0; run < data.scenes.size(); ++run) {
    std::vector<double> cosine(count, 0);
    std::vector<double> sine(count, 0);
    for (Index i = data.starts[run]; i < data.starts[run + 1]; i += every) {
      if (e[i] == 0) continue;
      const double angle = kTurn_rad * spacing * x[i];
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
    for (std::size_t line = 0; line < count; ++line) {
      power[line] += cosine[line] * cosine[line] + sine[line] * sine[line];
    }
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

// Of all samples: where, or when in its run.
VectorXd along(const Data& data, bool in_time) {
  VectorXd x(data.samples());
  for (std::size_t i = 0; i < data.scenes.size(); ++i) {
    const Run& run = *data.scenes[i].run;
    auto part = x.segment(data.starts[i], run.size());
    part = in_time ? VectorXd::LinSpaced(run.size(), 0,
                                         run.period_s * static_cast<double>(run.size() - 1))
                   : run.position_m;
  }
  return x;
}

}  // namespace

std::vector<double> turns_of(const Data& data, const VectorXd& e, Key frequency_key,
                             double frequency) {
  const VectorXd x = along(data, frequency_key == Key::kPeriodicHertz);
  const Index every = std::max<Index>(1, x.size() / kMostSamples);
  std::vector<double> turns;
  for (std::size_t run = 0; run < data.scenes.size(); ++run) {
    double cosine = 0;
    double sine = 0;
    for (Index i = data.starts[run]; i < data.starts[run + 1]; i += every) {
      cosine += e[i] * std::cos(kTurn_rad * frequency * x[i]);
      sine += e[i] * std::sin(kTurn_rad * frequency * x[i]);
    }
    turns.push_back(-std::atan2(sine, cosine) / kTurn_rad);
  }
  const double first = turns.front();
  for (double& t : turns) t -= first;
  return turns;
}

void find_lines(const Data& data, const VectorXd& e, Context& c) {
  const VectorXd place = along(data, false);
  const VectorXd time = along(data, true);
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
  c.lines_per_m = strongest(data, place, e, per_m, along);
  // Slower than once a run is a drift.
  c.lines_Hz = strongest(data, time, e, hertz, in_time);
  std::erase_if(c.lines_per_m, [&](double f) { return f * c.stroke_m < 2; });
  std::erase_if(c.lines_Hz, [&](double f) { return f * c.duration_s < 4; });
}

}  // namespace towbench::study::diagnose
