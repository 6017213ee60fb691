// The safety stop of one axis: active braking to standstill, then no power, in bounded time
// (defect 3). Served once an exchange, whatever the control rate.
//
//   tau = -K_b omega, |tau| <= the smaller of drive limit and gear limit
//
// At speed that is full reverse torque; near standstill it holds the motor against the chain, which
// takes the carriage's swing out instead of letting it run on. Standstill counts only when it
// lasts, because the motor passes through zero while the carriage still swings.
//
// An encoder that lies, or an amplifier that inverts or does not follow, makes this law push: when
// the speed grows well beyond what it was, or has not fallen long after it should have, the drive
// is given up.
//
// Blind, with an encoder that is not believed, it is full reverse torque for as long as the rigid
// axis takes to stand from a speed that is still known (dead_reckoning.h), and no longer. The
// encoder has one say left: when it begins with the speed as it was and then goes the way that the
// brake pushes, it was right, an obstacle has stopped the axis, and nothing is left to brake. And
// where it says that the axis gets faster, it may be the amplifier that lies.
#pragma once

#include "bbmc/system/axis_configuration.h"
#include "core/realtime.h"
#include "core/time.h"

namespace towbench::bbmc {

enum class BrakeState : std::uint8_t { kBraking, kStandstill, kTimedOut, kRanAway };

class Brake {
 public:
  explicit Brake(const AxisConfiguration& axis) noexcept;

  // `coasting`: no torque, only the wait for standstill (for comparison, see SafetyConfiguration).
  void begin(core::Nanoseconds now_ns, double speed_count_per_s, bool coasting) noexcept;

  // From a speed that is known now and will not be measured any more.
  void begin_blind(core::Nanoseconds now_ns, double speed_count_per_s) noexcept;
  [[nodiscard]] bool blind() const noexcept { return blind_; }

  TOWBENCH_REALTIME [[nodiscard]] BrakeState update(core::Nanoseconds now_ns,
                                                    double speed_count_per_s) noexcept;

  // Motor torque to apply until the next update; 0 once it does not brake any more.
  [[nodiscard]] double torque_Nm() const noexcept { return torque_Nm_; }

 private:
  // Whether the encoder has something to say for itself (see above).
  [[nodiscard]] bool encoder_explains(core::Nanoseconds now_ns,
                                      double onwards_count_per_s) noexcept;
  [[nodiscard]] BrakeState update_blind(core::Nanoseconds now_ns,
                                        double speed_count_per_s) noexcept;

  BrakingConfiguration settings_;
  double limit_Nm_;
  double rad_per_count_;
  double standstill_count_per_s_;
  core::Nanoseconds begun_ns_ = 0;
  core::Nanoseconds moved_ns_ = 0;  // last time above standstill
  double start_speed_count_per_s_ = 0;
  core::Nanoseconds must_have_slowed_ns_ = 0;
  core::Nanoseconds blind_until_ns_ = 0;
  double blind_direction_ = 0;            // of the motion
  core::Nanoseconds unexplained_ns_ = 0;  // last time it had not
  double torque_Nm_ = 0;
  bool coasting_ = false;
  bool blind_ = false;
  bool swapped_ = false;
};

}  // namespace towbench::bbmc
