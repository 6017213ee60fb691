// What a hard end ahead asks of the brake that an end-stop called.
//
// With an end ahead the carriage counts, not the motor. One that swings on its chain, since a tooth
// was skipped or a host slept, may run on while the motor stands already:
//
//   omega_l = (J omega - J_rotor omega_m) / J_l      omega of the whole axis, omega_m of the motor
//
// Against a motor that stands it runs on until the chain, stretched by s already, has taken its
// speed:
//
//   sqrt((omega_l / w_h)^2 + s^2) - s
//
// Where that is about the way left from the end-stop to the hard end, reckoned from the end-stop's
// word on, the brake presses: full reverse, whatever the motor does. Elsewhere its own law takes
// the swing out more gently.
//
// Where the whole way from the end-stop is shorter than what the motor must turn back until the
// chain pulls with that torque, pressing would only make the axis swing. There the motor turns back
// at a fifth of the speed with which the end-stop was reached, while the carriage runs on, and only
// where it might run on too far on a chain softer and with a carriage heavier by a tenth than the
// drawings': a host that is suspended meanwhile leaves the motor turning.
#pragma once

#include "bbmc/system/axis_configuration.h"
#include "bbmc/system/brake_input.h"
#include "core/realtime.h"
#include "core/time.h"

namespace towbench::bbmc {

enum class EndAsks : std::uint8_t { kNothing, kPress, kTurnBack };

class EndAhead {
 public:
  explicit EndAhead(const AxisConfiguration& axis) noexcept;

  // No end ahead, until told.
  void reset() noexcept { direction_ = 0; }
  // `direction` +1 towards max; how far the hard end is from the end-stop.
  void tell(double direction, double room_count) noexcept;

  // `torque_Nm` acted since the last update, `since_ns` ago, which is `a_gap` if nobody served.
  TOWBENCH_REALTIME [[nodiscard]] EndAsks update(const BrakeInput& input, double torque_Nm,
                                                 core::Nanoseconds since_ns, bool a_gap) noexcept;

  [[nodiscard]] double direction() const noexcept { return direction_; }  // 0 = no end ahead
  // Whether the way from this end-stop is long enough for that.
  [[nodiscard]] bool may_press() const noexcept {
    return direction_ != 0 && room_count_ > full_stretch_count_;
  }
  // What the motor turns back with.
  [[nodiscard]] double turning_count_per_s() const noexcept;

 private:
  [[nodiscard]] double onwards_count_per_s(const BrakeInput& input, double torque_Nm,
                                           core::Nanoseconds since_ns, bool a_gap) noexcept;
  [[nodiscard]] double runs_on_count(double onwards_count_per_s) const noexcept;

  double rotor_share_;  // of the axis's inertia
  double inertia_Nm_s2_per_count_;
  double held_rad_per_s_;      // of the carriage on a held motor
  double full_stretch_count_;  // of the chain, at the brake's torque
  double goes_on_count_per_s_;
  double direction_ = 0;
  double room_count_ = 0;        // from the end-stop to the hard end
  double run_count_ = 0;         // of the carriage, since the end-stop spoke
  double stretch_count_ = 0;     // of the chain, what the carriage ran further than the motor since
  double axis_count_per_s_ = 0;  // of the whole, since then
  double reached_count_per_s_ = 0;  // of the carriage, then
  core::Nanoseconds since_ns_ = 0;  // when that was
  bool heard_ = false;
  bool turns_back_ = false;
};

}  // namespace towbench::bbmc
