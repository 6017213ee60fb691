#include "study/identify/plateau.h"

#include <algorithm>
#include <cmath>

namespace towbench::study::identify {
namespace {

struct Line {
  double slope = 0;
  double middle = 0;
};

Line line_through(const Recording& data, core::Axis axis, std::size_t from, std::size_t to) {
  double t = 0;
  double x = 0;
  const auto n = static_cast<double>(to - from);
  for (std::size_t k = from; k < to; ++k) {
    t += data.time_s[k] / n;
    x += data.position_m(axis, k) / n;
  }
  double tt = 0;
  double tx = 0;
  for (std::size_t k = from; k < to; ++k) {
    tt += (data.time_s[k] - t) * (data.time_s[k] - t);
    tx += (data.time_s[k] - t) * (data.position_m(axis, k) - x);
  }
  return {tx / tt, x};
}

}  // namespace

std::vector<Plateau> find_plateaus(const Recording& data, core::Axis axis, double duty_pct) {
  constexpr std::size_t kBlocks = 6;
  constexpr double kSteady = 5e-3;
  constexpr double kNormal95Of6 = 2.571;  // Student, 5 degrees of freedom
  std::vector<Plateau> found;
  const auto& duty = data.axes[axis].duty_pct;
  for (std::size_t k = 0; k < data.rows();) {
    std::size_t end = k;
    while (end < data.rows() && std::fabs(std::fabs(duty[end]) - duty_pct) < 0.051 &&
           duty[end] * duty[k] > 0) {
      ++end;
    }
    if (end < k + 200) {
      k = std::max(end, k + 1);
      continue;
    }
    // The last third, in blocks: their slopes say whether it is steady, and how sure the mean is.
    const std::size_t from = end - (end - k) / 3;
    const std::size_t block = (end - from) / kBlocks;
    double mean = 0;
    double square = 0;
    double first = 0;
    double last = 0;
    for (std::size_t i = 0; i < kBlocks; ++i) {
      const double v = line_through(data, axis, from + i * block, from + (i + 1) * block).slope;
      mean += v / kBlocks;
      square += v * v / kBlocks;
      first = i == 0 ? v : first;
      last = v;
    }
    if (std::fabs(last - first) < kSteady * std::fabs(mean)) {
      const auto line = line_through(data, axis, from, end);
      const double spread = std::sqrt(std::max(0.0, square - mean * mean) / (kBlocks - 1));
      found.push_back({line.slope, kNormal95Of6 * spread, line.middle,
                       (last - first) / (data.time_s[end - 1] - data.time_s[from])});
    }
    k = end;
  }
  return found;
}

}  // namespace towbench::study::identify
