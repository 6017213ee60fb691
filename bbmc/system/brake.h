// The safety stop of one axis: active braking to standstill, then no power, in bounded time
// (defect 3). Served once an exchange, whatever the control rate.
//
//   tau = -K_b omega, |tau| <= the smaller of drive limit and gear limit
//
// At speed that is full reverse torque; near standstill it holds the motor against the chain, which
// takes the carriage's swing out instead of letting it run on. Standstill counts only when it
// lasts, because the motor passes through zero while the carriage still swings.
//
// A wrong encoder reading, or an amplifier that inverts or does not follow, makes this law push:
// when the speed grows well beyond what it was, or has not fallen long after it should have, the
// drive is given up. But a chain that skips throws the light motor as fast: so at first the drive
// is only taken away. A motor that was thrown is slow again within half a swing on the chain, and
// the brake goes on; one that was pushed is not.
//
// A speed that comes late (a slow link, a clock that leapt ahead) turns that law into an
// oscillator: the light motor answers within 2 ms. Then the brake first takes the axis's momentum
// out, full reverse for as long as the rigid axis takes, and is as soft afterwards as the delay
// asks:
//
//   K_b <= 0.5 J_rotor / d (1 - 4 d f)     d delay, f of the motor against the carriage, free
//
// The first factor is a third of what makes J_rotor omega' = -K omega(t - d) swing for ever (pi/2),
// the second ends it where a quarter of the chain's own swing has passed, beyond which the law
// would drive the swing.
//
// With an end ahead the carriage counts, not the motor: end_ahead.h says when to press, full
// reverse whatever the motor does, and when to turn back a little, tau = -K_b (omega - omega_back).
//
// After a gap (a host that slept) the last torque has gone on, whatever it was: the speed found
// then says nothing against the brake, and its momentum is taken out first, too.
//
// Blind, with an encoder that is not believed, it is full reverse torque for as long as the rigid
// axis takes to stand from a speed that is still known (dead_reckoning.h), and no longer. The
// encoder has one say left: when it begins with the speed as it was and then goes the way that the
// brake pushes, it was right, an obstacle has stopped the axis, and nothing is left to brake. And
// where it says that the axis gets faster, it may be the amplifier that lies.
#pragma once

#include "bbmc/system/axis_configuration.h"
#include "bbmc/system/brake_input.h"
#include "bbmc/system/end_ahead.h"
#include "core/realtime.h"
#include "core/time.h"

namespace towbench::bbmc {

enum class BrakeState : std::uint8_t { kBraking, kStandstill, kTimedOut, kRanAway };

class Brake {
 public:
  explicit Brake(const AxisConfiguration& axis) noexcept;

  // `coasting`: no torque, only the wait for standstill (for comparison, see SafetyConfiguration).
  void begin(const BrakeInput& input, bool coasting) noexcept;
  // An end-stop says so: `direction` +1 towards max, and how far the hard end is from it.
  void end_is_ahead(double direction, double room_count) noexcept {
    end_.tell(direction, room_count);
  }

  // From a speed that is known now and will not be measured any more; `may_explain`: whether the
  // encoder has that last say.
  void begin_blind(core::Nanoseconds now_ns, double speed_count_per_s, bool may_explain) noexcept;
  [[nodiscard]] bool blind() const noexcept { return blind_; }

  TOWBENCH_REALTIME [[nodiscard]] BrakeState update(const BrakeInput& input) noexcept;

  // Motor torque to apply until the next update; 0 once it does not brake any more.
  [[nodiscard]] double torque_Nm() const noexcept { return torque_Nm_; }

 private:
  // Whether the encoder has something to say for itself (see above).
  [[nodiscard]] bool encoder_explains(core::Nanoseconds now_ns,
                                      double onwards_count_per_s) noexcept;
  [[nodiscard]] BrakeState update_blind(const BrakeInput& input) noexcept;
  [[nodiscard]] BrakeState judge(const BrakeInput& input) noexcept;
  void begin_again_after_gap(const BrakeInput& input) noexcept;
  void push(const BrakeInput& input) noexcept;
  [[nodiscard]] bool runs_away(core::Nanoseconds now_ns, double speed_count_per_s) noexcept;
  void update_latency(const BrakeInput& input) noexcept;
  [[nodiscard]] double damped_gain_Nm_s_per_rad() const noexcept;
  [[nodiscard]] double wanted_torque_Nm(const BrakeInput& input) const noexcept;
  [[nodiscard]] core::Nanoseconds rigid_stop_ns(double speed_count_per_s) const noexcept;

  BrakingConfiguration settings_;
  double limit_Nm_;
  double rad_per_count_;
  double standstill_count_per_s_;
  EndAhead end_;
  EndAsks asks_ = EndAsks::kNothing;
  core::Nanoseconds begun_ns_ = 0;
  core::Nanoseconds moved_ns_ = 0;  // last time above standstill
  double start_speed_count_per_s_ = 0;
  core::Nanoseconds must_have_slowed_ns_ = 0;
  core::Nanoseconds blind_until_ns_ = 0;
  double blind_direction_ = 0;            // of the motion
  core::Nanoseconds unexplained_ns_ = 0;  // last time it had not
  core::Nanoseconds max_age_ns_ = 0;      // the greatest age of late
  core::Nanoseconds max_age_at_ns_ = 0;   // when that was
  core::Nanoseconds updated_ns_ = 0;
  core::Nanoseconds push_from_ns_ = 0;
  core::Nanoseconds push_until_ns_ = 0;
  double push_direction_ = 0;
  core::Nanoseconds thrown_ns_ = 0;
  double free_chain_Hz_;
  double pressed_back_count_per_s_;
  double top_speed_count_per_s_;
  double torque_Nm_ = 0;
  bool coasting_ = false;
  bool blind_ = false;
  bool late_ = false;
  bool after_gap_ = false;
  bool swapped_ = false;
  bool may_explain_ = false;
  bool gives_way_ = false;
};

}  // namespace towbench::bbmc
