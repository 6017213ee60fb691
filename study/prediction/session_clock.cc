#include "study/prediction/session_clock.h"

#include <algorithm>

namespace towbench::study::diagnose {
namespace {

constexpr double kLongestPause_s = 3600;  // after which nothing that warmed is warm

double end_s(const Run& run) {
  return run.start_s + run.period_s * static_cast<double>(run.size() - 1);
}

}  // namespace

std::vector<double> starts_on_one_clock(const std::vector<const Run*>& runs) {
  std::vector<const Run*> in_order = runs;
  std::sort(in_order.begin(), in_order.end(),
            [](const Run* a, const Run* b) { return a->start_s < b->start_s; });
  for (std::size_t i = 1; i < in_order.size(); ++i) {
    const double pause_s = in_order[i]->start_s - end_s(*in_order[i - 1]);
    if (pause_s <= 0 || pause_s > kLongestPause_s) return {};
  }
  std::vector<double> starts_s;
  for (const Run* run : runs) starts_s.push_back(run->start_s - in_order.front()->start_s);
  return starts_s;
}

}  // namespace towbench::study::diagnose
