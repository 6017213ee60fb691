// How fast an axis goes when its encoder is not believed any more: as fast as it went before
// anything can have been wrong, and what the drive has done to the rigid axis since.
//
//   omega = omega(t - 64 ms) + 1/J integral of tau_motor dt      friction left out: a few per cent
//
// A wrong encoder reading is found within 50 ms (60 ms on a machine that is not the one
// configured), so what it said 64 ms ago is true, unless it has lied from the start. Then it is
// found within 5 mm, which at more than 0.078 m/s takes less than 64 ms: slower speeds are not
// believed here.
//
// Where only the link is in doubt, what the encoder said last was true. But the motor swings on the
// chain: the speed of the axis as a whole is the mean over the last 112 ms (a swing of Y's
// chain, two of X's) of
//
//   omega(t_k) + 1/J integral from t_k of tau_motor dt
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>

#include "bbmc/system/axis_configuration.h"
#include "core/realtime.h"
#include "core/time.h"

namespace towbench::bbmc {

class DeadReckoning {
 public:
  explicit DeadReckoning(const AxisConfiguration& axis) noexcept
      : count_per_s_per_Nm_s_(1.0 / (axis.braking.inertia_kg_m2 * axis.rad_per_count())),
        least_count_per_s_(kLeast_m_per_s * axis.counts_per_m()),
        most_count_per_s_(axis.speed_limit_m_per_s * axis.counts_per_m()) {}

  // Once an exchange: the speed that the encoder tells, the torque asked of the motor since the
  // last.
  TOWBENCH_REALTIME void update(core::Nanoseconds now_ns, double speed_count_per_s,
                                double torque_Nm, double elapsed_s) noexcept {
    impulse_Nm_s_ += torque_Nm * elapsed_s;
    forget_after_gap(elapsed_s, speed_count_per_s, now_ns);
    if (now_ns - history_[newest_].time_ns >= kStep_ns) {
      newest_ = (newest_ + 1) % kSteps;
      history_[newest_] = {now_ns, speed_count_per_s, impulse_Nm_s_};
    }
  }

  // 0 where no speed can be trusted.
  TOWBENCH_REALTIME [[nodiscard]] double speed_count_per_s() const noexcept {
    const Entry& then = history_[(newest_ + kSteps - kTrustedSteps) % kSteps];
    if (std::fabs(then.speed_count_per_s) < least_count_per_s_) {
      return 0;
    }
    const double trusted =
        std::clamp(then.speed_count_per_s, -most_count_per_s_, most_count_per_s_);
    return unless_turned(trusted, since(then));
  }

  // Of the rigid axis, however slow it was.
  TOWBENCH_REALTIME [[nodiscard]] double rigid_count_per_s() const noexcept {
    const Entry& then = history_[(newest_ + kSteps - kTrustedSteps) % kSteps];
    return then.speed_count_per_s + since(then);
  }

  // With an encoder that is believed; 0 where the axis (nearly) stands.
  TOWBENCH_REALTIME [[nodiscard]] double momentum_count_per_s() const noexcept {
    double told = 0;
    double gained = 0;
    for (const Entry& entry : history_) {
      told += entry.speed_count_per_s / static_cast<double>(kSteps);
      gained += since(entry) / static_cast<double>(kSteps);
    }
    return std::fabs(told) < kNearlyStands * least_count_per_s_ ? 0 : unless_turned(told, gained);
  }

 private:
  static constexpr double kLeast_m_per_s = 0.08;
  static constexpr double kNearlyStands = 0.125;  // of that
  static constexpr core::Nanoseconds kStep_ns = 8 * core::kNanosecondsPerMillisecond;
  static constexpr std::size_t kSteps = 14;        // the oldest is 104 to 112 ms old
  static constexpr std::size_t kTrustedSteps = 8;  // before the newest: 64 to 72 ms old
  static constexpr double kGap_s = 0.02;
  static constexpr double kSwingsBack = 0.2;  // of the mean; less is an axis that has stopped

  struct Entry {
    core::Nanoseconds time_ns = 0;
    double speed_count_per_s = 0;
    double impulse_Nm_s = 0;
  };

  // Nobody has looked for a while: what was before says nothing. The first speed after it is the
  // mean of all that time, the next is the motor's now. The axis as a whole may still be as fast as
  // the mean where the motor just swings back.
  void forget_after_gap(double elapsed_s, double speed_count_per_s,
                        core::Nanoseconds now_ns) noexcept {
    if (elapsed_s > kGap_s) {
      forgets_ = true;
      mean_of_gap_count_per_s_ = speed_count_per_s;
    } else if (forgets_ && elapsed_s > 0) {
      const double share = speed_count_per_s / mean_of_gap_count_per_s_;  // not finite: no mean
      const bool swings_back = share > kSwingsBack && share < 1;
      history_.fill(
          {now_ns, swings_back ? mean_of_gap_count_per_s_ : speed_count_per_s, impulse_Nm_s_});
      forgets_ = false;
    }
  }
  [[nodiscard]] double since(const Entry& entry) const noexcept {
    return (impulse_Nm_s_ - entry.impulse_Nm_s) * count_per_s_per_Nm_s_;
  }
  // Turned round meanwhile: too slow to be worth a guess.
  [[nodiscard]] static double unless_turned(double told, double gained) noexcept {
    return (told + gained) * told > 0 ? told + gained : 0;
  }

  std::array<Entry, kSteps> history_{};
  std::size_t newest_ = 0;
  double impulse_Nm_s_ = 0;
  bool forgets_ = false;
  double mean_of_gap_count_per_s_ = 0;
  double count_per_s_per_Nm_s_;
  double least_count_per_s_;
  double most_count_per_s_;
};

}  // namespace towbench::bbmc
