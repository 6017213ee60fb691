// The end-stops of one axis: which edge of a hall switch stops the machine (defects 1 and 13).
//
// Armed in every motion, both ends, whatever the direction: a switch that is wired to the wrong end
// must stop the axis too. The one exception is the switch that the axis is just leaving: it was
// active when the motion began, and while it is left it may bounce.
//
// Besides the edges, levels are looked at: an axis that moves towards an active switch is stopped,
// should its edge have been missed.
#pragma once

#include <array>
#include <cstdint>

#include "bbmc/system/axis_configuration.h"
#include "core/error.h"
#include "core/realtime.h"

namespace towbench::bbmc {

enum class End : std::uint8_t { kMin = 0, kMax = 1 };

[[nodiscard]] constexpr core::ErrorCode end_stop_fault(End end) noexcept {
  return end == End::kMin ? core::ErrorCode::kFaultEndStopMin : core::ErrorCode::kFaultEndStopMax;
}

class EndStopGuard {
 public:
  explicit EndStopGuard(const AxisConfiguration& axis) noexcept;

  // A motion begins at `count`.
  void arm(std::int64_t count) noexcept;

  // Homing looks for the switch at `end`: neither its edge nor running on for `overrun_counts`
  // beyond it stops the machine, until the next arm(). The other switch stays what it is.
  void expect(End end, std::int64_t overrun_counts) noexcept;
  // Whether the expected switch has closed since, and the raw count at that edge.
  [[nodiscard]] bool found() const noexcept { return found_; }
  [[nodiscard]] std::int64_t found_count() const noexcept { return found_count_; }

  // An edge of the switch at `end`, `age_s` ago; by now the axis is at `count` with `speed`. True
  // when it stops the machine, motion given.
  TOWBENCH_REALTIME [[nodiscard]] bool edge(End end, bool active, std::int64_t count,
                                            double speed_count_per_s, double age_s) noexcept;
  // Levels as they are, for switches that were active before anybody listened for edges.
  void see(bool min_active, bool max_active) noexcept { active_ = {min_active, max_active}; }
  // Whether the axis, at `count`, moves towards an active switch; `end` says which.
  TOWBENCH_REALTIME [[nodiscard]] bool moves_into(std::int64_t count, double speed_count_per_s,
                                                  End& end) const noexcept;

  [[nodiscard]] bool active(End end) const noexcept {
    return active_[static_cast<std::size_t>(end)];
  }

 private:
  [[nodiscard]] bool is_expected(End end) const noexcept { return expecting_ && end == expected_; }
  // The expected switch, run into by no more than was granted.
  [[nodiscard]] bool is_granted(End end, std::int64_t count) const noexcept;

  std::array<bool, 2> active_{};
  std::array<bool, 2> leaving_{};
  std::int64_t start_count_ = 0;
  std::int64_t leave_counts_;
  double standstill_count_per_s_;
  std::int64_t found_count_ = 0;
  std::int64_t overrun_counts_ = 0;
  End expected_ = End::kMin;
  bool expecting_ = false;
  bool found_ = false;
};

}  // namespace towbench::bbmc
