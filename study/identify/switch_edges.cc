#include "study/identify/switch_edges.h"

#include <cmath>

namespace towbench::study::identify {
namespace {

// A stretch of rows whose reference runs at one speed.
struct Steady {
  std::size_t from = 0;
  std::size_t last = 0;
  double speed_m_per_s = 0;
};

std::vector<Steady> steady_runs(const std::vector<double>& speeds) {
  constexpr std::size_t kShortest = 50;
  std::vector<Steady> runs;
  for (std::size_t k = 0; k < speeds.size();) {
    std::size_t last = k;
    while (last + 1 < speeds.size() && speeds[last + 1] == speeds[k]) {
      ++last;
    }
    if (speeds[k] != 0 && last >= k + kShortest) {
      runs.push_back({k, last, speeds[k]});
    }
    k = last + 1;
  }
  return runs;
}

// The row before that in which the reference moves again; 0: it never does.
std::size_t end_of_rest(const std::vector<double>& speeds, std::size_t k) {
  while (k < speeds.size() && speeds[k] != 0) {
    ++k;
  }
  while (k < speeds.size() && speeds[k] == 0) {
    ++k;
  }
  return k < speeds.size() ? k - 1 : 0;
}

// The row's count is of before or after the declaration, as the controller logs it.
void declare(const std::vector<std::int64_t>& counts, SwitchApproach& approach) {
  const auto jump = [&](std::size_t k) { return static_cast<double>(counts[k] - counts[k - 1]); };
  const std::size_t k = approach.declared;
  if (k + 1 < counts.size() && std::fabs(jump(k + 1)) > std::fabs(jump(k))) {
    approach.declared = k + 1;
  }
  approach.shift_counts = jump(approach.declared);
}

}  // namespace

std::vector<SwitchApproach> find_switch_approaches(const Recording& data, core::Axis axis,
                                                   double slow_m_per_s) {
  const auto& speeds = data.axes[axis].reference_velocity_m_per_s;
  const auto& counts = data.axes[axis].count;
  const auto runs = steady_runs(speeds);
  std::vector<SwitchApproach> found;
  for (std::size_t i = 0; i < runs.size(); ++i) {
    if (std::fabs(std::fabs(runs[i].speed_m_per_s) / slow_m_per_s - 1) > 1e-6) {
      continue;
    }
    SwitchApproach approach;
    approach.outward = runs[i].speed_m_per_s > 0 ? 1 : -1;
    approach.slow_edge = runs[i].last;
    approach.declared = end_of_rest(speeds, runs[i].last + 1);
    if (approach.declared == 0) {
      continue;
    }
    declare(counts, approach);
    approach.fast_from = approach.fast_edge = runs[i].from;
    const std::size_t since = found.empty() ? 0 : found.back().declared;
    for (std::size_t j = i; j-- > 0 && runs[j].from > since;) {
      if (runs[j].speed_m_per_s * approach.outward > slow_m_per_s) {
        approach.fast_from = runs[j].from;
        approach.fast_edge = runs[j].last;
        break;
      }
    }
    found.push_back(approach);
  }
  return found;
}

std::vector<double> counts_in_one_frame(const Recording& data, core::Axis axis,
                                        const std::vector<SwitchApproach>& all) {
  std::vector<double> counts;
  counts.reserve(data.rows());
  double shift = 0;
  std::size_t next = 0;
  for (std::size_t k = 0; k < data.rows(); ++k) {
    if (next < all.size() && all[next].declared == k) {
      shift += all[next++].shift_counts;
    }
    counts.push_back(static_cast<double>(data.axes[axis].count[k]) + 0.5 - shift);
  }
  return counts;
}

}  // namespace towbench::study::identify
