// The control path: a sample in, a drive command out. No heap, lock, system call or exception.
//
// Served once an exchange: line edges, guards and brakes every time, the law when a control tick is
// due. So what stops the machine does not wait for the control rate.
#pragma once

#include <cstdint>

#include "bbmc/system/approach_profile.h"
#include "bbmc/system/axis_control.h"
#include "bbmc/system/control_sample.h"
#include "bbmc/system/data_log.h"
#include "bbmc/system/homing.h"
#include "bbmc/system/motion_request.h"
#include "bbmc/system/system_event.h"
#include "bbmc/system/system_status.h"
#include "core/realtime.h"
#include "core/spsc_queue.h"

namespace towbench::bbmc {

// A request that has been checked, on its way into the control path.
struct MotionOrder {
  MotionKind kind = MotionKind::kNone;
  PerAxis<bool> driven{};
  PerAxis<Trajectory> trajectory{};  // kReference
  PerAxis<DutyProgram> program{};    // kOpenLoop
  PerAxis<double> target_m{};        // kGoto
  PerAxis<bool> homes{};             // kHoming: driven, but not homing, is held
  PerAxis<End> home_end{};           // kHoming
  RelayParameters relay{};           // kTuning
  bool until_settled = false;
  bool fast = false;
  double stop_speed_count_per_s = 0;
};

class MotionControl {
 public:
  MotionControl(const Configuration& configuration, core::Nanoseconds exchange_ns,
                DataLog& log) noexcept;

  TOWBENCH_REALTIME void exchange(const ControlSample& sample, LineEdgeQueue& line_edges,
                                  DriveCommand& command) noexcept;

  // ---- from the application's side, between exchanges ----
  // False when one is still waiting.
  [[nodiscard]] bool submit(const MotionOrder& order) noexcept { return orders_.push(order); }
  void request_stop() noexcept { stop_requested_ = true; }
  void clear_fault() noexcept;
  void link_lost(core::ErrorCode why, core::Nanoseconds now_ns) noexcept;
  [[nodiscard]] AxisControl& axis(core::Axis which) noexcept { return axes_[which]; }
  [[nodiscard]] const AxisControl& axis(core::Axis which) const noexcept { return axes_[which]; }

  [[nodiscard]] const SystemStatus& status() const noexcept { return status_; }
  // Nothing moves under power, nothing waits to.
  [[nodiscard]] bool at_rest() const noexcept;
  [[nodiscard]] bool braking() const noexcept;

  [[nodiscard]] bool next_row(TelemetryRow& row) noexcept { return rows_.pop(row); }
  [[nodiscard]] bool next_event(SystemEvent& event) noexcept { return events_.pop(event); }
  [[nodiscard]] std::uint64_t lost() const noexcept { return lost_; }

  void set_control_period(core::Nanoseconds period_ns) noexcept { period_ns_ = period_ns; }
  void set_cross_coupling(const CrossCouplingConfiguration& wanted) noexcept {
    configuration_.cross_coupling = wanted;
  }
  void publish() noexcept;

 private:
  struct Motion {
    MotionOrder order;
    PerAxis<ApproachProfile> approach;
    PerAxis<HomingSequence> homing;
    PerAxis<RelayTuner> tuner;
    PerAxis<double> across_path_m;  // of this tick, times the gain ratio
    core::Nanoseconds start_ns = 0;
    core::Nanoseconds settled_since_ns = 0;
    double duration_s = 0;
    bool settled = false;
    PerAxis<bool> has_stood{};  // for long enough to be at rest, since it began
  };

  // motion_safety.cc: what stops the machine.
  void serve_line(const Aintc::Reading& edge) noexcept;
  void watch(const ControlSample& sample) noexcept;
  void watch_clock(core::Nanoseconds time_ns) noexcept;
  void watch_axis(core::Axis which, const ControlSample& sample) noexcept;
  void serve_brakes() noexcept;
  void latch(core::ErrorCode code, core::Axis which) noexcept;
  void brake_all(core::ErrorCode code, core::Axis which) noexcept;
  void cut_one(core::ErrorCode code, core::Axis which) noexcept;
  void give_up_encoder(core::ErrorCode code, core::Axis which,
                       AxisControl::Suspect suspect) noexcept;
  void give_up_encoders(core::ErrorCode code) noexcept;
  void cut_all(core::ErrorCode code, core::Axis which) noexcept;
  void settle_after_fault() noexcept;
  void power_off(core::Axis which, AxisMode mode, core::ErrorCode why) noexcept;

  // motion_control.cc: what moves it.
  void tick(const ControlSample& sample) noexcept;
  void begin_waiting_order(core::Nanoseconds now_ns) noexcept;
  void drive_axis(core::Axis which, double time_s, double step_s) noexcept;
  void drive_approach(core::Axis which, double step_s) noexcept;
  void find_error_across_path(double time_s) noexcept;
  void check_tracking() noexcept;

  // motion_homing.cc: finds out where it is.
  void begin_homing(core::Axis which) noexcept;
  void drive_homing(core::Axis which, double step_s) noexcept;
  void declare_at_switch(core::Axis which) noexcept;

  // motion_end.cc: when a motion is over.
  [[nodiscard]] bool motion_is_over(double time_s, core::ErrorCode& result) noexcept;
  [[nodiscard]] bool tuning_is_over(core::ErrorCode& result) noexcept;
  // Whether the axis is as near to its reference as a settled motion must be.
  [[nodiscard]] bool is_near(core::Axis which) const noexcept;
  // For the integral of an axis whose reference has come to rest.
  [[nodiscard]] double settling_ratio(core::Axis which) const noexcept;
  [[nodiscard]] bool settled_long_enough() noexcept;
  [[nodiscard]] bool broke_away() noexcept;
  void end_motion(core::ErrorCode result) noexcept;
  void finish_motion_when_at_rest() noexcept;

  // motion_record.cc: what is kept of it.
  void record(const ControlSample& sample) noexcept;
  void record_log() noexcept;
  void post(SystemEvent::Kind kind, core::Axis which, core::ErrorCode code,
            std::int64_t value = 0) noexcept;
  void post_at(core::Nanoseconds time_ns, SystemEvent::Kind kind, core::Axis which,
               core::ErrorCode code, std::int64_t value) noexcept;
  void set_mode_event(core::Axis which) noexcept;
  [[nodiscard]] bool any_powered() const noexcept;

  Configuration configuration_;
  DataLog* log_;
  core::Nanoseconds period_ns_;
  core::Nanoseconds exchange_ns_;
  PerAxis<AxisControl> axes_;
  Motion motion_;
  SystemStatus status_;
  core::Nanoseconds now_ns_ = 0;
  core::Nanoseconds last_tick_ns_ = 0;
  core::Nanoseconds last_served_ns_ = -1;  // none yet
  core::ErrorCode motion_result_ = core::ErrorCode::kNone;
  std::uint16_t lines_ = 0;
  std::uint64_t lost_ = 0;
  bool motion_ending_ = false;  // its result is known, axes still come to rest
  bool stop_requested_ = false;
  bool log_full_told_ = false;
  core::SpscQueue<MotionOrder, 1> orders_;
  core::SpscQueue<TelemetryRow, 2048> rows_;
  core::SpscQueue<SystemEvent, 1024> events_;
};

}  // namespace towbench::bbmc
