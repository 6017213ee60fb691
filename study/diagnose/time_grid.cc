#include "study/diagnose/time_grid.h"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "study/statistics/statistics.h"

namespace towbench::study::diagnose {
namespace {

using Kind = logs::Finding::Kind;

constexpr double kJitterShare = 0.05;  // of the period, rms, above which the user is told
constexpr double kMissingShare = 0.2;  // of the samples, above which the log is refused
constexpr double kLargestGapPeriods = 1.5;
// A line across a gap g is off by a g^2 / 8: 3 um at 2 m/s2, of the order of an encoder's step.
constexpr double kBridged_s = 3.5e-3;
// Below it friction and inertia of a carriage are not seen apart; above it time is in no second.
constexpr double kSlowest_Hz = 50;
constexpr double kFastest_Hz = 200e3;
constexpr double kSteady = 3;  // by which the period of one stretch may differ from another's

std::vector<double> gaps_of(const std::vector<double>& time_s) {
  std::vector<double> gaps;
  gaps.reserve(time_s.size());
  for (std::size_t j = 1; j < time_s.size(); ++j) {
    gaps.push_back(time_s[j] - time_s[j - 1]);
  }
  return gaps;
}

double roughness(const Eigen::VectorXd& x) {
  const Eigen::Index n = x.size() - 2;
  return (x.tail(n) - 2 * x.segment(1, n) + x.head(n)).squaredNorm();
}

}  // namespace

TimeGrid::TimeGrid(const logs::Table& table, const LogColumns& columns, double time_scale_s,
                   const std::string& file, logs::Findings& findings)
    : rows_(columns.rows), file_(file), findings_(findings) {
  time_s_.reserve(rows_.size());
  for (const std::size_t row : rows_) {
    time_s_.push_back(time_scale_s * (*columns.time)[row]);
  }
  if (rises(table) && is_steady()) {
    find_gaps();
    choose_times(*columns.position);
  }
}

void TimeGrid::tell(Kind kind, const char* name, std::string sentence) {
  findings_.push_back({kind, name, std::move(sentence)});
}

bool TimeGrid::rises(const logs::Table& table) {
  for (std::size_t j = 1; j < time_s_.size(); ++j) {
    if (time_s_[j] <= time_s_[j - 1]) {
      tell(
          Kind::kFatal, "time_not_rising",
          fmt::format("{}:{}: time goes from {:.9g} to {:.9g} s and must rise; are two runs in one "
                      "file?",
                      file_, table.line[rows_[j]], time_s_[j - 1], time_s_[j]));
      return false;
    }
  }
  return true;
}

bool TimeGrid::is_steady() {
  const std::vector<double> gaps = gaps_of(time_s_);
  const double typical = statistics::median(gaps);
  if (1 / typical < kSlowest_Hz || 1 / typical > kFastest_Hz) {
    tell(Kind::kFatal, "sampling_rate_off",
         fmt::format("{}: a sample every {:.3g} s, allowed are {:g} Hz to {:g} kHz; is time in ms "
                     "or us (time_scale_s of a column map)?",
                     file_, typical, kSlowest_Hz, 1e-3 * kFastest_Hz));
    return false;
  }
  constexpr std::ptrdiff_t kStretches = 8;
  const std::ptrdiff_t length = std::ssize(gaps) / kStretches;
  for (std::ptrdiff_t i = 0; i < kStretches; ++i) {
    const auto from = gaps.begin() + i * length;
    const double here = statistics::median({from, from + length});
    if (here > kSteady * typical || typical > kSteady * here) {
      tell(Kind::kFatal, "sampling_changes",
           fmt::format("{}: a sample every {:.3g} s in one part and every {:.3g} s in another; is "
                       "time in two units?",
                       file_, std::min(here, typical), std::max(here, typical)));
      return false;
    }
  }
  const double span = time_s_.back() - time_s_.front();
  const double intervals = std::round(span / typical);
  const double share = 1 - static_cast<double>(rows_.size()) / (intervals + 1);
  if (share > kMissingShare) {
    tell(Kind::kFatal, "missing_samples",
         fmt::format("{}: {:.0f} % of the samples are missing, at most {:.0f} % may be", file_,
                     100 * share, 100 * kMissingShare));
    return false;
  }
  period_s_ = span / intervals;
  samples_ = static_cast<Eigen::Index>(intervals) + 1;
  return true;
}

void TimeGrid::find_gaps() {
  uniform_ = static_cast<std::size_t>(samples_) == rows_.size();
  missing_.assign(static_cast<std::size_t>(samples_), 0);
  std::size_t lost = 0;
  for (std::size_t j = 1; j < time_s_.size(); ++j) {
    const double ideal = time_s_.front() + static_cast<double>(j) * period_s_;
    uniform_ = uniform_ && std::abs(time_s_[j] - ideal) <= 0.01 * period_s_;
    const double gap = time_s_[j] - time_s_[j - 1];
    if (gap <= kLargestGapPeriods * period_s_) {
      continue;
    }
    const auto place = [&](std::size_t k) { return (time_s_[k] - time_s_.front()) / period_s_; };
    const auto end = std::min(samples_, static_cast<Eigen::Index>(std::ceil(place(j) - 0.01)));
    for (auto k = static_cast<Eigen::Index>(place(j - 1) + 0.01) + 1; k < end; ++k) {
      ++lost;
      missing_[static_cast<std::size_t>(k)] = gap > kBridged_s ? 1 : 0;
    }
  }
  if (lost > 0) {
    tell(Kind::kNote, "missing_samples",
         fmt::format("{}: {} samples ({:.2g} %) are missing; gaps above {:g} ms are left out of "
                     "every test",
                     file_, lost, 100 * static_cast<double>(lost) / static_cast<double>(samples_),
                     1e3 * kBridged_s));
  }
}

double TimeGrid::jitter_share() const {
  double sum = 0;
  for (std::size_t j = 1; j < time_s_.size(); ++j) {
    const double gap = (time_s_[j] - time_s_[j - 1]) / period_s_;
    const double off = gap - std::round(gap);
    sum += off * off;
  }
  return std::sqrt(sum / static_cast<double>(time_s_.size()));
}

// Each stamp on the next point of the grid; empty when two would share one.
std::vector<double> TimeGrid::evened() const {
  std::vector<double> even;
  even.reserve(time_s_.size());
  double last = -1;
  for (const double t : time_s_) {
    const double at = std::round((t - time_s_.front()) / period_s_);
    if (at <= last) {
      return {};
    }
    last = at;
    even.push_back(time_s_.front() + at * period_s_);
  }
  return even;
}

void TimeGrid::choose_times(const std::vector<double>& position) {
  const double share = jitter_share();
  std::vector<double> other = uniform_ || share <= kJitterShare ? std::vector<double>{} : evened();
  const char* taken = "as they say";
  if (!other.empty()) {
    const double as_stamped = roughness(resampled(position, 1));
    std::swap(time_s_, other);
    if (roughness(resampled(position, 1)) < as_stamped) {
      taken = "evenly";
    } else {
      std::swap(time_s_, other);
    }
  }
  if (!uniform_ && share > kJitterShare) {
    tell(
        Kind::kNote, "jittered_time",
        fmt::format("{}: time stamps jitter by {:.0f} % of the period; by the position the samples "
                    "were taken {}; resampled at {:.6g} Hz",
                    file_, 100 * share, taken, 1 / period_s_));
  }
}

Eigen::VectorXd TimeGrid::resampled(const std::vector<double>& column, double scale) const {
  Eigen::VectorXd out(samples_);
  std::size_t j = 0;
  for (Eigen::Index k = 0; k < samples_; ++k) {
    const double t = time_s_.front() + static_cast<double>(k) * period_s_;
    while (j + 2 < time_s_.size() && time_s_[j + 1] <= t) {
      ++j;
    }
    const double w = std::clamp((t - time_s_[j]) / (time_s_[j + 1] - time_s_[j]), 0.0, 1.0);
    out[k] = uniform_ ? scale * column[rows_[static_cast<std::size_t>(k)]]
                      : scale * ((1 - w) * column[rows_[j]] + w * column[rows_[j + 1]]);
  }
  return out;
}

}  // namespace towbench::study::diagnose
