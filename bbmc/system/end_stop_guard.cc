#include "bbmc/system/end_stop_guard.h"

namespace towbench::bbmc {
namespace {

// After so much travel away from a switch its edges are no bounce any more. A latching switch
// releases as far as 20 mm back.
constexpr double kLeaving_m = 0.025;

}  // namespace

EndStopGuard::EndStopGuard(const AxisConfiguration& axis) noexcept
    : leave_counts_(static_cast<std::int64_t>(kLeaving_m * axis.counts_per_m())),
      standstill_count_per_s_(axis.braking.standstill_m_per_s * axis.counts_per_m()) {}

void EndStopGuard::arm(std::int64_t count) noexcept {
  start_count_ = count;
  leaving_ = active_;
  expecting_ = false;
}

void EndStopGuard::expect(End end, std::int64_t overrun_counts) noexcept {
  expected_ = end;
  overrun_counts_ = overrun_counts;
  expecting_ = true;
  found_ = false;
}

bool EndStopGuard::is_granted(End end, std::int64_t count) const noexcept {
  if (!is_expected(end) || !found_) {
    return false;  // active without an edge: that edge was lost
  }
  const std::int64_t beyond = end == End::kMax ? count - found_count_ : found_count_ - count;
  return beyond <= overrun_counts_;
}

bool EndStopGuard::edge(End end, bool active, std::int64_t count, double speed_count_per_s,
                        double age_s) noexcept {
  const auto i = static_cast<std::size_t>(end);
  active_[i] = active;
  if (active && is_expected(end)) {
    if (!found_) {
      found_count_ = count - static_cast<std::int64_t>(speed_count_per_s * age_s);
    }
    found_ = true;
    return false;
  }
  const double outward = end == End::kMax ? 1.0 : -1.0;
  const std::int64_t travelled =
      end == End::kMax ? start_count_ - count : count - start_count_;  // away from this end
  if (travelled > leave_counts_) {
    leaving_[i] = false;
  }
  const bool bounces = leaving_[i] && outward * speed_count_per_s <= standstill_count_per_s_;
  return active && !bounces;
}

bool EndStopGuard::moves_into(std::int64_t count, double speed_count_per_s,
                              End& end) const noexcept {
  if (active(End::kMin) && speed_count_per_s < -standstill_count_per_s_ &&
      !is_granted(End::kMin, count)) {
    end = End::kMin;
    return true;
  }
  if (active(End::kMax) && speed_count_per_s > standstill_count_per_s_ &&
      !is_granted(End::kMax, count)) {
    end = End::kMax;
    return true;
  }
  return false;
}

}  // namespace towbench::bbmc
