// Whether the encoder of an axis can be believed (defect 5). Judged once an exchange from what the
// encoder says and what the drive was told, while the axis is driven.
//
//   kinematic   the count cannot change its rate faster than the drive can accelerate the rotor
//               alone (times kTorqueMargin, for the chain pulls too): frozen, dead channel, jump or
//               inversion at speed
//   held        no edge at all, though the swing that would explain it has changed by more than
//               friction can hold, and without the swing the drive would have moved the axis
//   stuck       drive above worst-case break-away, motion that the rigid model must make is absent:
//               frozen encoder or dead channel from rest
//   reversed    the same drive, and the axis speeds up against it
//   illegal     both channels change at once
//   noise       edges that lead nowhere
//   index       an index pulse off its place, or none for 1.1 turns: edges lost, index lost
//
// "Break-away" is worst_breakaway_Nm plus what external_load_N asks at the motor, so that a load
// that is allowed to be held is no fault. What the carriage swinging on its chain asks of the motor
// (chain_observer.h) is taken off the drive first: a motor that holds against it does not push. A
// quarter of the swing is allowed for, because the chain is known roughly at best.
#pragma once

#include <cstdint>

#include "bbmc/system/axis_configuration.h"
#include "bbmc/system/chain_observer.h"
#include "bbmc/system/index_watch.h"
#include "core/error.h"
#include "core/realtime.h"
#include "core/time.h"

namespace towbench::bbmc {

// What happened since the exchange before.
struct EncoderChange {
  core::Nanoseconds time_ns = 0;  // end of the interval
  double elapsed_s = 0;
  std::int64_t raw_count = 0;  // unwrapped, not calibrated
  std::int64_t counts = 0;
  std::uint32_t edges = 0;
  bool edges_known = true;
  std::uint32_t illegal_transitions = 0;
  std::uint32_t index_pulses = 0;
  std::int64_t index_raw_count = 0;
  double speed_count_per_s = 0;  // estimated
  double torque_Nm = 0;          // asked of the drive during the interval
};

class EncoderPlausibility {
 public:
  explicit EncoderPlausibility(const AxisConfiguration& axis) noexcept;

  enum class Scope : std::uint8_t {
    kNothing,     // not driven: memory is kept up to date, nothing is found
    kSignals,     // braking: all but stuck and reversed. The drive follows the speed there, so a
                  // frozen encoder gets no torque, and a motor that holds the carriage is not stuck
    kEverything,  // driven
  };

  // kNone, or the fault.
  TOWBENCH_REALTIME [[nodiscard]] core::ErrorCode update(const EncoderChange& change,
                                                         Scope scope) noexcept;

  static constexpr double kTorqueMargin = 2.5;

 private:
  // Motion that the drive must have caused since it went above break-away in one direction.
  struct Push {
    double direction = 0;  // of the torque; 0 = below break-away
    double model_speed_rad_per_s = 0;
    double model_travel_rad = 0;
    double start_speed_count_per_s = 0;
    std::int64_t start_count = 0;
    // Of the window that is judged for absence of motion; starts anew when it was moving.
    double window_start_travel_rad = 0;
    std::int64_t lowest_count = 0;
    std::int64_t highest_count = 0;
  };
  // Of a motor without an edge, since the last one: the torque left when the observed swing is
  // taken off the drive, and the motion that the drive alone must have made.
  struct Held {
    double lowest_Nm = 0;
    double highest_Nm = 0;
    double model_speed_rad_per_s = 0;
    double model_travel_rad = 0;
  };
  // Events in the current and in the last 10 ms.
  struct Bucket {
    std::int64_t current = 0;
    std::int64_t last = 0;
    [[nodiscard]] std::int64_t sum() const noexcept { return current + last; }
  };

  [[nodiscard]] core::ErrorCode judge(const EncoderChange& change, Scope scope,
                                      bool index_good) noexcept;
  [[nodiscard]] core::ErrorCode judge_kinematics(const EncoderChange& change) const noexcept;
  [[nodiscard]] core::ErrorCode judge_push(const EncoderChange& change) noexcept;
  [[nodiscard]] bool is_held_by_nothing() const noexcept;
  void watch_for_motion(const EncoderChange& change) noexcept;
  void begin_push(const EncoderChange& change, double direction) noexcept;
  void count_events(const EncoderChange& change) noexcept;

  PlausibilityConfiguration settings_;
  double breakaway_Nm_;
  double inertia_kg_m2_;
  double rad_per_count_;
  double max_acceleration_count_per_s2_;
  Push push_;
  ChainObserver chain_;
  double chain_torque_Nm_ = 0;
  double swing_Nm_ = 0;  // largest of late, fading
  Held held_;
  IndexWatch index_;
  Bucket illegal_;
  Bucket noise_;
  core::Nanoseconds bucket_start_ns_ = 0;
  double last_rate_count_per_s_ = 0;
  double last_elapsed_s_ = 0;
};

}  // namespace towbench::bbmc
