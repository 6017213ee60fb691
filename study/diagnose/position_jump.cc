#include "study/diagnose/position_jump.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include <fmt/format.h>

namespace towbench::study::diagnose {
namespace {

constexpr double kFastestShare = 0.995;  // of the samples that move: what the body does at most
constexpr double kTooFar = 20;           // times that in one sample

double longest_honest_step(const Eigen::VectorXd& position_m) {
  std::vector<double> steps;
  for (Eigen::Index i = 1; i < position_m.size(); ++i) {
    const double step = std::abs(position_m[i] - position_m[i - 1]);
    if (step > 0) {
      steps.push_back(step);
    }
  }
  if (steps.empty()) {
    return 0;
  }
  const auto at = static_cast<std::ptrdiff_t>(kFastestShare * static_cast<double>(steps.size()));
  const auto nth = steps.begin() + std::min(at, std::ssize(steps) - 1);
  std::nth_element(steps.begin(), nth, steps.end());
  return *nth;
}

}  // namespace

void join_position_jumps(Run& run, logs::Findings& findings) {
  const double longest_m = kTooFar * longest_honest_step(run.position_m);
  for (Eigen::Index i = 1; i < run.size(); ++i) {
    const double step_m = run.position_m[i] - run.position_m[i - 1];
    if (std::abs(step_m) <= longest_m) {
      continue;
    }
    run.position_m.head(i).array() += step_m;
    run.missing[static_cast<std::size_t>(i)] = 1;
    findings.push_back(
        {logs::Finding::Kind::kNote, "position_jump",
         fmt::format("{}: the position jumps by {:.4g} m at {:.6g} s, as of a preset counter; what "
                     "lies before was moved to join",
                     run.name, step_m, static_cast<double>(i) * run.period_s)});
  }
}

}  // namespace towbench::study::diagnose
