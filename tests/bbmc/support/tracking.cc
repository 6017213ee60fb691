#include "tests/bbmc/support/tracking.h"

#include <algorithm>
#include <cmath>

#include "bbmc/system/trajectory/harmonic.h"
#include "bbmc/system/trajectory/s_curve.h"
#include "bbmc/system/trajectory/trapezoid.h"
#include "tests/bbmc/support/machine.h"

namespace towbench::tests {
namespace {

using core::Axis;

constexpr double kStartY_m = 0.449092;  // firmware
constexpr double kStartX_m = 0.336819;  // firmware
constexpr double kRamp_s = 0.8;
constexpr double kSteady_s = 3.0;
constexpr double kWait_s = 0.5;
// The chain's and the integrator's transients are over.
constexpr double kTransient_s = 1.0;

Machine::Options machine_for(const Law& law, double start_y_m, double start_x_m) {
  Machine::Options options;
  options.configuration = tuned(law);
  options.start_m = {{start_y_m, start_x_m}};
  return options;
}

// The truth of the same instant as a row of the controller.
class TruthAt {
 public:
  explicit TruthAt(const std::vector<emulator::TruthRow>& rows) : rows_(rows) {}
  const emulator::TruthRow* find(core::Nanoseconds time_ns) {
    while (next_ < rows_.size() && rows_[next_].time_ns < time_ns) {
      ++next_;
    }
    return next_ < rows_.size() && rows_[next_].time_ns == time_ns ? &rows_[next_] : nullptr;
  }

 private:
  const std::vector<emulator::TruthRow>& rows_;
  std::size_t next_ = 0;
};

double larger(double a, double b) {
  return std::max(a, std::fabs(b));
}

}  // namespace

bbmc::Configuration tuned(const Law& law) {
  bbmc::Configuration configuration;
  configuration.axes[Axis::kY].gains = {.proportional_Nm_per_rad = 0.05,
                                        .integral_Nm_per_rad_s = 0.5,
                                        .derivative_Nm_s_per_rad = 6e-4};
  configuration.axes[Axis::kX].gains = {.proportional_Nm_per_rad = 0.02,
                                        .integral_Nm_per_rad_s = 0.2,
                                        .derivative_Nm_s_per_rad = 2e-4};
  if (law.stiff) {
    configuration.axes[Axis::kY].gains = {0.2, 0.5, 1.2e-3};
    configuration.axes[Axis::kX].gains = {0.08, 0.2, 4e-4};
  }
  for (auto& axis : configuration.axes) {
    axis.feed_forward.enabled = law.feed_forward;
    axis.friction.enabled = law.friction;
    axis.disturbance_observer.enabled = law.observer;
    axis.chain.enabled = law.chain;
    axis.nonlinear_observer.enabled = law.nonlinear_observer;
    axis.state_observer.enabled = law.full_state;
    axis.chain.smoothing_rad_per_s = 0.3;
  }
  // As bbmc-best.toml: where an axis reverses, it is break-away that stretches the chain.
  configuration.axes[Axis::kY].chain.carriage_friction_Nm = 2.4e-3;
  configuration.axes[Axis::kX].chain.carriage_friction_Nm = 1.56e-3;
  configuration.cross_coupling.enabled = law.cross_coupling;
  return configuration;
}

TrapezoidFigures measure_trapezoid(const Law& law, Axis axis, double speed_m_per_s,
                                   const emulator::RigParameters& rig) {
  Machine::Options options = machine_for(law, kStartY_m, axis == Axis::kX ? 0.1 : kStartX_m);
  options.rig = rig;
  Machine machine(options);
  const double room_m = axis == Axis::kX ? 0.42 : 1e9;
  const double distance_m = std::min(room_m, speed_m_per_s * (kRamp_s + kSteady_s));
  const bbmc::TrapezoidParameters wanted{.start_m = machine.status(axis).position_m,
                                         .distance_m = distance_m,
                                         .speed_m_per_s = speed_m_per_s,
                                         .acceleration_time_s = kRamp_s,
                                         .deceleration_time_s = kRamp_s,
                                         .wait_s = kWait_s};
  const double held_s = 1.0 / bbmc::Configuration().axes[axis].braking.held_motor_chain_Hz;
  bbmc::MotionRequest request;
  for (Axis each : core::kPlanarAxes) {
    request.driven[each] = true;
    request.trajectory[each] = bbmc::Hold(machine.status(each).position_m);
  }
  double end_s = bbmc::Trapezoid::make(wanted).value().duration_s();
  if (law.chain) {
    const bbmc::SCurve curve = bbmc::SCurve::make(wanted, held_s).value();
    request.trajectory[axis] = curve;
  } else {
    request.trajectory[axis] = bbmc::Trapezoid::make(wanted).value();
  }
  machine.rows.clear();
  const double start_s = machine.time_s();
  TrapezoidFigures figures;
  if (!machine.system().request_motion(request) || !machine.run_until_rest(30.0)) {
    return figures;
  }
  figures.sound = machine.system().status().fault == core::ErrorCode::kNone;
  const double from_s = kWait_s + kRamp_s + kTransient_s;
  const double to_s = end_s - kRamp_s;
  TruthAt truth(machine.truth);
  double n = 0;
  for (const auto& row : machine.rows) {
    const auto& state = row.axes[axis];
    const double error_m = state.reference_m - state.position_m;
    figures.peak_error_m = larger(figures.peak_error_m, error_m);
    if (const auto* known = truth.find(row.time_ns)) {
      figures.carriage_peak_m =
          larger(figures.carriage_peak_m, state.reference_m - known->axes[axis].carriage_m);
    }
    const double t = core::seconds(row.time_ns) - start_s;
    if (t >= from_s && t < to_s) {
      figures.mean_error_m += error_m;
      figures.rms_error_m += error_m * error_m;
      figures.mean_velocity_error_m_per_s +=
          state.reference_velocity_m_per_s - state.velocity_m_per_s;
      n += 1;
    }
  }
  figures.mean_error_m /= n;
  figures.mean_velocity_error_m_per_s /= n;
  figures.rms_error_m = std::sqrt(figures.rms_error_m / n);
  return figures;
}

CircleFigures measure_circle(const Law& law) {
  constexpr double kRadius_m = 0.20;
  Machine machine(machine_for(law, kStartY_m, kStartX_m));
  const bbmc::PhaseRampParameters phase{
      .frequency_hz = 1.0 / 7.0, .turns = 2, .ramp_s = 1, .wait_s = kWait_s};
  const double y0 = machine.status(Axis::kY).position_m;
  const double x0 = machine.status(Axis::kX).position_m;
  bbmc::MotionRequest request;
  request.driven = {{true, true}};
  request.trajectory[Axis::kY] =
      bbmc::Harmonic::make({.start_m = y0, .amplitude_m = kRadius_m, .phase = phase}).value();
  request.trajectory[Axis::kX] =
      bbmc::Harmonic::make(
          {.start_m = x0, .amplitude_m = kRadius_m, .starting_phase_turns = 0.25, .phase = phase})
          .value();
  machine.rows.clear();
  CircleFigures figures;
  if (!machine.system().request_motion(request) || !machine.run_until_rest(40.0)) {
    return figures;
  }
  figures.sound = machine.system().status().fault == core::ErrorCode::kNone;
  const double centre_y = y0 + kRadius_m;
  TruthAt truth(machine.truth);
  double n = 0;
  const auto off_circle = [&](double y, double x) {
    return std::sqrt((y - centre_y) * (y - centre_y) + (x - x0) * (x - x0)) - kRadius_m;
  };
  for (const auto& row : machine.rows) {
    for (Axis axis : core::kPlanarAxes) {
      figures.peak_error_m[axis] = larger(figures.peak_error_m[axis],
                                          row.axes[axis].reference_m - row.axes[axis].position_m);
    }
    figures.path_peak_m = larger(figures.path_peak_m, off_circle(row.axes[Axis::kY].position_m,
                                                                 row.axes[Axis::kX].position_m));
    if (const auto* known = truth.find(row.time_ns)) {
      const double off_m =
          off_circle(known->axes[Axis::kY].carriage_m, known->axes[Axis::kX].carriage_m);
      figures.carriage_path_peak_m = larger(figures.carriage_path_peak_m, off_m);
      figures.carriage_path_rms_m += off_m * off_m;
      n += 1;
    }
  }
  figures.carriage_path_rms_m = std::sqrt(figures.carriage_path_rms_m / n);
  return figures;
}

}  // namespace towbench::tests
