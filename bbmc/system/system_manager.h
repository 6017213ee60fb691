// The face of the system layer: every request of the application layer comes through here, and is
// carried out or refused with a numbered error. A refused request has changed nothing.
//
// States, per axis (AxisMode):
//
//            request_open_loop / request_motion / request_goto
//   idle ------------------------------------------------------> open loop, position, velocity
//    ^  ^                                                          |        |
//    |  +------------- reference over, held, power off ------------+        | stop, end-stop,
//    limit, |  +------------- standstill (user's stop) <---- braking <-------------+ encoder of
//    other axis |                                                   | standstill or time-out, fault
//    latched
//    +------------- reset, switch released ---- faulted <+---- kill switch, own encoder, link: at
//    once
//
// A fault concerns the whole machine: one axis's fault stops the other.
#pragma once

#include <cstdint>
#include <span>

#include "bbmc/system/configuration.h"
#include "bbmc/system/control_sample.h"
#include "bbmc/system/data_log.h"
#include "bbmc/system/device_io.h"
#include "bbmc/system/motion_control.h"
#include "bbmc/system/motion_request.h"
#include "bbmc/system/perf_log.h"
#include "bbmc/system/system_event.h"
#include "bbmc/system/system_status.h"
#include "bbmc/system/telemetry_row.h"
#include "core/realtime.h"
#include "core/result.h"
#include "core/spsc_queue.h"

namespace towbench::bbmc {

class SystemManager {
 public:
  // `configuration` is valid (inconsistency() is null). Devices and log storage outlive this, which
  // is large: not for a stack.
  SystemManager(const Configuration& configuration, DeviceManager& devices,
                std::span<DataLogRow> log_storage);
  SystemManager(const SystemManager&) = delete;
  SystemManager& operator=(const SystemManager&) = delete;
  ~SystemManager() = default;

  // Opens and initialises every device and starts the control timer. First of all calls.
  [[nodiscard]] core::Status start() noexcept;

  // ---- requests ----
  // Refused: a fault is latched, a motion runs, the kill switch is pressed, a reference leaves the
  // soft limits or is too fast for its place (before calibration: for the nearer end), or does not
  // start where the axis is. What is accepted starts with the next control tick.
  [[nodiscard]] core::Status request_motion(const MotionRequest& request) noexcept;
  [[nodiscard]] core::Status request_open_loop(const OpenLoopRequest& request) noexcept;
  // Also refused before position calibration.
  [[nodiscard]] core::Status request_goto(const GotoRequest& request) noexcept;

  // Both switches of an axis active at once is refused too: there is no way off.
  [[nodiscard]] core::Status request_homing(const HomingRequest& request) noexcept;

  // kRequestOutOfRange for an amplitude that is none, or an axis that is not there.
  [[nodiscard]] core::Status request_tuning(const TuningRequest& request) noexcept;

  // Brakes to standstill, then idle; latches nothing. kRequestWrongState when nothing moves.
  [[nodiscard]] core::Status stop() noexcept;

  // Clears a latched fault. Refused with kRequestSwitchPressed while the kill switch is pressed,
  // and with kRequestWrongState while an axis still brakes or when nothing is latched.
  [[nodiscard]] core::Status reset() noexcept;

  // Declares that the axis stands at `count`. Only at rest with no motion.
  [[nodiscard]] core::Status calibrate_position(core::Axis axis, std::int64_t count) noexcept;
  // The position is not known any more; the count goes on.
  [[nodiscard]] core::Status forget_calibration(core::Axis axis) noexcept;

  // From the next control tick on, also in motion: the change is bumpless. Gains are finite, >= 0.
  [[nodiscard]] core::Status set_gains(core::Axis axis, const PidGains& gains) noexcept;
  // Only with no motion.
  // What is added to the PID (control_law.h), as `parts` has it; the rest of `parts` is not looked
  // at.
  [[nodiscard]] core::Status set_law(core::Axis axis, const AxisConfiguration& parts) noexcept;
  [[nodiscard]] core::Status set_cross_coupling(const CrossCouplingConfiguration& wanted) noexcept;
  [[nodiscard]] core::Status set_velocity_method(core::Axis axis, VelocityMethod method) noexcept;
  // Ticks of a PWM period (10 .. 65535) and largest duty (1 .. 100 %); only with no motion.
  [[nodiscard]] core::Status set_drive(core::Axis axis, std::int64_t pwm_period_ticks,
                                       double duty_limit_pct) noexcept;
  // Also refused: a period that is no multiple of the exchange, gains unstable at that rate.
  [[nodiscard]] core::Status set_control_rate(double rate_Hz) noexcept;

  // ---- what is known ----
  [[nodiscard]] const Configuration& configuration() const noexcept;
  [[nodiscard]] const SystemStatus& status() const noexcept;
  // No motion runs, none is about to start, nothing brakes.
  [[nodiscard]] bool at_rest() const noexcept;
  // The largest speed that planning allows the axis at a place, in a direction (+1 towards max):
  // what can be stopped before the end, or uncalibrated what the nearer end can stop.
  [[nodiscard]] double speed_allowed_m_per_s(core::Axis axis, double position_m,
                                             int direction) const noexcept;
  [[nodiscard]] DataLog& data_log() noexcept;
  [[nodiscard]] PerfLog& perf_log() noexcept;

  // ---- served by the board ----
  // Interrupts, safety and, when due, the control tick; then everything decided has been written to
  // the devices. Called once an exchange with the board's time, in order.
  TOWBENCH_REALTIME void service(core::Nanoseconds now_ns) noexcept;
  // The other end of the wire is gone, or its frames are: drive off at once, fault latched.
  void link_lost(core::ErrorCode why) noexcept;

  // One consumer, any thread. False when none is waiting.
  [[nodiscard]] bool next_row(TelemetryRow& row) noexcept;
  [[nodiscard]] bool next_event(SystemEvent& event) noexcept;
  // Rows and events that found their queue full.
  [[nodiscard]] std::uint64_t rows_lost() const noexcept;

 private:
  // Why no motion can be asked for now; kNone when one can.
  [[nodiscard]] core::ErrorCode why_not_now() const noexcept;
  [[nodiscard]] core::Status order(const MotionOrder& order) noexcept;
  void serve_interrupts() noexcept;

  Configuration configuration_;
  core::Nanoseconds exchange_ns_;
  DeviceIo io_;
  DataLog log_;
  PerfLog perf_;
  MotionControl motion_;
  ControlSample sample_;
  // Around the control path: what goes in and what comes out.
  LineEdgeQueue line_edges_;
  core::SpscQueue<ControlSample, 2> samples_;
  core::SpscQueue<DriveCommand, 2> commands_;
};

}  // namespace towbench::bbmc
