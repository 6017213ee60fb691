#include "tests/bbmc/support/speed_errors.h"

#include <algorithm>
#include <cmath>

#include "bbmc/system/state_observer.h"
#include "bbmc/system/trajectory/hold.h"
#include "bbmc/system/trajectory/trapezoid.h"
#include "tests/bbmc/support/machine.h"
#include "tests/bbmc/support/tracking.h"

namespace towbench::tests {
namespace {

using core::Axis;

bbmc::Configuration with(SpeedSource source) {
  bbmc::Configuration configuration = tuned({.name = "PID"});
  for (auto& axis : configuration.axes) {
    axis.velocity.method = source == SpeedSource::kFrequency ? bbmc::VelocityMethod::kFrequency
                           : source == SpeedSource::kPeriod  ? bbmc::VelocityMethod::kPeriod
                                                             : bbmc::VelocityMethod::kHybrid;
    axis.state_observer.enabled = source == SpeedSource::kObserver;
  }
  return configuration;
}

bool drive(Machine& machine, double speed_m_per_s) {
  bbmc::MotionRequest request;
  for (const Axis each : core::kPlanarAxes) {
    request.driven[each] = true;
    request.trajectory[each] = bbmc::Hold(machine.status(each).position_m);
  }
  request.trajectory[Axis::kY] =
      bbmc::Trapezoid::make({.start_m = machine.status(Axis::kY).position_m,
                             .distance_m = speed_m_per_s * 3.8,
                             .speed_m_per_s = speed_m_per_s,
                             .acceleration_time_s = 0.8,
                             .deceleration_time_s = 0.8,
                             .wait_s = 0.5})
          .value();
  machine.rows.clear();
  return static_cast<bool>(machine.system().request_motion(request)) &&
         machine.run_until_rest(30.0) && machine.system().status().fault == core::ErrorCode::kNone;
}

}  // namespace

SpeedFigures measure_speed(SpeedSource source, double speed_m_per_s) {
  Machine::Options options;
  options.configuration = with(source);
  options.start_m = {{0.449092, 0.336819}};
  Machine machine(options);
  SpeedFigures figures;
  figures.sound = drive(machine, speed_m_per_s);
  const auto& y = options.configuration.axes[Axis::kY];
  // The loop's own observer, run again on what it was given.
  bbmc::StateObserver again(y, options.configuration.control_rate_Hz);
  const double torque_per_duty_Nm = y.drive.full_duty_torque_Nm() / 100;
  double applied_Nm = 0;
  double n = 0;
  std::size_t next = 0;
  for (const auto& row : machine.rows) {
    const auto& state = row.axes[Axis::kY];
    if (state.mode != bbmc::AxisMode::kPosition) {
      continue;
    }
    bbmc::AxisState full;
    if (again.works()) {
      full = again.update(state.position_m / y.metres_per_motor_rad(),
                          state.velocity_m_per_s / y.metres_per_motor_rad(), applied_Nm,
                          1 / options.configuration.control_rate_Hz);
    }
    applied_Nm = torque_per_duty_Nm * state.duty_pct;
    while (next < machine.truth.size() && machine.truth[next].time_ns < row.time_ns) {
      ++next;
    }
    if (next == machine.truth.size() || machine.truth[next].time_ns != row.time_ns ||
        state.reference_velocity_m_per_s == 0) {
      continue;
    }
    const auto& truth = machine.truth[next].axes[Axis::kY];
    const double speed =
        again.works() ? full.motor_rad_per_s * y.metres_per_motor_rad() : state.velocity_m_per_s;
    const double off = speed - truth.motor_speed_rad_per_s * y.metres_per_motor_rad();
    const double stretch = truth.carriage_m - truth.motor_angle_rad * y.metres_per_motor_rad();
    const double tracking = state.reference_m - state.position_m;
    figures.speed_rms_m_per_s += off * off;
    figures.speed_largest_m_per_s = std::max(figures.speed_largest_m_per_s, std::fabs(off));
    figures.tracking_rms_m += tracking * tracking;
    figures.stretch_rms_m += stretch * stretch;
    if (again.works()) {
      const double carriage = full.carriage_rad * y.metres_per_motor_rad() - truth.carriage_m;
      const double carriage_speed =
          full.carriage_rad_per_s * y.metres_per_motor_rad() - truth.carriage_speed_m_per_s;
      figures.carriage_rms_m += carriage * carriage;
      figures.carriage_speed_rms_m_per_s += carriage_speed * carriage_speed;
    }
    n += 1;
  }
  for (double* each : {&figures.speed_rms_m_per_s, &figures.tracking_rms_m, &figures.stretch_rms_m,
                       &figures.carriage_rms_m, &figures.carriage_speed_rms_m_per_s}) {
    *each = n > 0 ? std::sqrt(*each / n) : 0;
  }
  figures.sound = figures.sound && n > 0;
  return figures;
}

}  // namespace towbench::tests
