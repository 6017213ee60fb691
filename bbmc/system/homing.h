// Position calibration of one axis against one of its hall switches, from an unknown place.
//
//   leave       off the switch, should the axis stand on it; then it need not be sought
//   seek        towards the end, at a share of what can be stopped between switch and hard end
//   back off    until the switch has released (a latching one does so far back) and clear of it
//   approach    again, slowly: the count at this edge is the calibration
//   clear       to inside the soft limit, so that what is planned next may start
//
// Each of the first four ends at rest. A switch that does not come within the axis's length, or
// does not release, is given up: the caller latches the fault of that end-stop.
//
// The switch acts on the carriage, the encoder sits on the motor, and between them the chain is
// stretched: at the edge the motor leads by tau_l / k, k = J_l w_h^2 (the held motor's chain,
// chain_observer.h). So slow an approach makes the carriage stick and slip, and the stretch swings
// with it; but the motor feels it: tau_l = tau - C_m, the torque at the edge less the motor's own
// friction, which is BBMC's belief (breakaway_Nm less the carriage's share). The lead is taken off.
#pragma once

#include <cstdint>

#include "bbmc/system/axis_configuration.h"
#include "bbmc/system/end_stop_guard.h"
#include "bbmc/system/stopping_distance.h"
#include "bbmc/system/trajectory/reference.h"
#include "core/realtime.h"

namespace towbench::bbmc {

class HomingSequence {
 public:
  // What the caller is to do besides following the reference.
  enum class Action : std::uint8_t {
    kNone,
    kExpectSwitch,  // EndStopGuard::expect()
    kLeaveSwitch,   // EndStopGuard::arm()
    kDeclare,       // the axis stands: declare its count by the switch, then frame_moved_to()
    kGiveUp,        // no switch, or one that never releases
  };
  struct Sample {
    double position_m = 0;
    bool switch_active = false;
    bool switch_found = false;  // EndStopGuard::found()
    bool stands_still = false;
    double torque_Nm = 0;  // asked of the motor
    double step_s = 0;
  };

  HomingSequence() noexcept = default;
  // `start_m` is where the axis stands, in whatever frame its positions have.
  HomingSequence(const AxisConfiguration& axis, const SpeedLimits& limits, End end, double start_m,
                 bool switch_active) noexcept;

  TOWBENCH_REALTIME [[nodiscard]] Action step(const Sample& sample) noexcept;
  // After kDeclare: where the axis stands in the calibrated frame.
  void frame_moved_to(double position_m) noexcept { reference_.position_m = position_m; }

  [[nodiscard]] const Reference& reference() const noexcept { return reference_; }
  [[nodiscard]] End end() const noexcept { return end_; }
  // Asked of the motor when the switch of the last approach closed, averaged.
  [[nodiscard]] double torque_at_switch_Nm() const noexcept {
    return 2.0 * torque_Nm_ - torque_twice_Nm_;
  }
  [[nodiscard]] bool done() const noexcept { return phase_ == Phase::kDone; }

 private:
  enum class Phase : std::uint8_t { kLeave, kSeek, kBackOff, kApproach, kClear, kDone };

  void enter(Phase phase) noexcept;
  // Changes the speed of the reference towards `speed_m_per_s` and moves it on.
  void move(double speed_m_per_s, double step_s) noexcept;
  [[nodiscard]] bool rests(const Sample& sample) noexcept;
  [[nodiscard]] Action go_off(const Sample& sample, Phase next) noexcept;
  [[nodiscard]] Action go_on(const Sample& sample, double speed_m_per_s, double longest_m,
                             Action then) noexcept;
  [[nodiscard]] Action go_clear(const Sample& sample) noexcept;

  End end_ = End::kMin;
  Phase phase_ = Phase::kDone;
  Reference reference_;
  double outward_ = -1;
  double seek_m_per_s_ = 0;
  double approach_m_per_s_ = 0;
  double acceleration_m_per_s2_ = 1;
  double back_off_m_ = 0;
  double release_m_ = 0;
  double length_m_ = 0;
  double clear_m_ = 0;
  double travelled_m_ = 0;  // since this phase began
  double released_m_ = 0;   // since the switch is clear
  double rested_s_ = 0;
  double torque_Nm_ = 0;        // averaged once
  double torque_twice_Nm_ = 0;  // and again
  bool stopping_ = false;
};

// How far the motor is ahead of the carriage, in counts, when a slow approach closes a switch under
// a torque of this magnitude; between 0 and twice what the believed friction stretches.
[[nodiscard]] double switch_lead_counts(const AxisConfiguration& axis, double torque_Nm) noexcept;

// How far beyond its edge homing may run into a switch without it being an end-stop: what a stop
// from the seeking speed takes, and a half more.
[[nodiscard]] std::int64_t homing_overrun_counts(const AxisConfiguration& axis,
                                                 const SpeedLimits& limits) noexcept;

}  // namespace towbench::bbmc
