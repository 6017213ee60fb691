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
}

bool EndStopGuard::edge(End end, bool active, std::int64_t count,
                        double speed_count_per_s) noexcept {
  const auto i = static_cast<std::size_t>(end);
  active_[i] = active;
  const double outward = end == End::kMax ? 1.0 : -1.0;
  const std::int64_t travelled =
      end == End::kMax ? start_count_ - count : count - start_count_;  // away from this end
  if (travelled > leave_counts_) {
    leaving_[i] = false;
  }
  const bool bounces = leaving_[i] && outward * speed_count_per_s <= standstill_count_per_s_;
  return active && !bounces;
}

bool EndStopGuard::moves_into(double speed_count_per_s, End& end) const noexcept {
  if (active(End::kMin) && speed_count_per_s < -standstill_count_per_s_) {
    end = End::kMin;
    return true;
  }
  if (active(End::kMax) && speed_count_per_s > standstill_count_per_s_) {
    end = End::kMax;
    return true;
  }
  return false;
}

}  // namespace towbench::bbmc
