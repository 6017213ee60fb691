#include "study/procedures/duty_apart.h"

#include <algorithm>
#include <cmath>
#include <vector>

namespace towbench::study::procedures {
namespace {

constexpr double kMean_s = 0.02;

// Rows [from, to) from a reference that sets off to the next that does.
struct Motion {
  std::size_t from = 0;
  std::size_t to = 0;
};

std::size_t rows_of_mean(const identify::Recording& log) {
  return std::max<std::size_t>(1, static_cast<std::size_t>(std::lround(kMean_s / log.period_s)));
}

std::vector<Motion> motions_of(const identify::Recording& log, core::Axis axis) {
  const auto& reference_m = log.axes[axis].reference_m;
  const auto rest = rows_of_mean(log);
  std::vector<Motion> motions;
  std::size_t stood = rest;  // before the log begins nothing moves
  for (std::size_t k = 1; k < log.rows(); ++k) {
    const bool moves = reference_m[k] != reference_m[k - 1];
    if (moves && stood >= rest) {
      if (!motions.empty()) {
        motions.back().to = k;
      }
      motions.push_back({.from = k, .to = log.rows()});
    }
    stood = moves ? 0 : stood + 1;
  }
  return motions;
}

class MeanSquare {
 public:
  void add(double value) {
    sum_ += value * value;
    ++count_;
  }
  [[nodiscard]] double root() const {
    return std::sqrt(sum_ / static_cast<double>(std::max<std::size_t>(count_, 1)));
  }

 private:
  double sum_ = 0;
  std::size_t count_ = 0;
};

double mean_duty_pct(const identify::Recording& log, core::Axis axis, std::size_t from,
                     std::size_t rows) {
  double sum = 0;
  for (std::size_t k = from; k < from + rows; ++k) {
    sum += log.axes[axis].duty_pct[k];
  }
  return sum / static_cast<double>(rows);
}

}  // namespace

double duty_apart_pct(const identify::Recording& one, const identify::Recording& other,
                      core::Axis axis) {
  const auto mine = motions_of(one, axis);
  const auto theirs = motions_of(other, axis);
  const auto rows = rows_of_mean(one);
  MeanSquare apart;
  for (std::size_t i = 0; i < std::min(mine.size(), theirs.size()); ++i) {
    const auto length = std::min(mine[i].to - mine[i].from, theirs[i].to - theirs[i].from);
    for (std::size_t k = 0; k + rows <= length; k += rows) {
      apart.add(mean_duty_pct(one, axis, mine[i].from + k, rows) -
                mean_duty_pct(other, axis, theirs[i].from + k, rows));
    }
  }
  return apart.root();
}

double duty_rms_pct(const identify::Recording& log, core::Axis axis) {
  const auto rows = rows_of_mean(log);
  MeanSquare duty;
  for (const auto& motion : motions_of(log, axis)) {
    for (std::size_t k = motion.from; k + rows <= motion.to; k += rows) {
      duty.add(mean_duty_pct(log, axis, k, rows));
    }
  }
  return duty.root();
}

}  // namespace towbench::study::procedures
