// One axis, one 100 us step: the plant beside the usual ways to integrate the same machine. Every
// time stands beside its error, the largest distance of the motor from the event-located oracle in
// encoder counts over the same run: a fast answer that is wrong does not count.
//
// The fixed-step ways smooth the sign of friction by tanh, as they must to run at all; dopri5 and
// CVODE have the oracle's located events.
#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <vector>

#include <benchmark/benchmark.h>
#include <boost/numeric/odeint.hpp>

#include "tests/support/axis_commands.h"
#include "tests/support/axis_fixture.h"
#include "tests/support/axis_optional_terms.h"
#include "tests/support/axis_oracle.h"

namespace towbench {
namespace {

namespace odeint = boost::numeric::odeint;
using tests::AxisOracle;
using State = AxisOracle::State;

constexpr double kDuration_s = 5.0;
constexpr double kStart_m = 2.0;
constexpr double kCountsPerRadian = 4000 / (2 * M_PI);

const std::vector<tests::CommandHistory>& histories() {
  static const auto all = tests::command_histories(kDuration_s);
  return all;
}

emulator::AxisParameters axis_of(bool every_term) {
  return every_term ? tests::with_every_term(tests::nominal_y()) : tests::nominal_y();
}

// Motor position in counts at the end of every tick.
const std::vector<double>& truth_counts(std::size_t which, bool every_term) {
  static std::map<std::pair<std::size_t, bool>, std::vector<double>> cache;
  std::vector<double>& counts = cache[{which, every_term}];
  if (counts.empty()) {
    AxisOracle oracle(axis_of(every_term), kStart_m, 1e-9);
    for (const double volts : histories()[which].volts) {
      oracle.advance({.command_V = volts}, 1e-4);
      counts.push_back(oracle.motor_counts());
    }
  }
  return counts;
}

// Runs a history tick by tick, timed; reports ns a tick and the error of the last run.
template <typename MakeStepper>
void run(benchmark::State& state, const MakeStepper& make_stepper, bool every_term = false) {
  const auto which = static_cast<std::size_t>(state.range(0));
  const auto& volts = histories()[which].volts;
  const auto& truth = truth_counts(which, every_term);
  std::vector<double> counts(volts.size());
  for (auto _ : state) {
    auto stepper = make_stepper();
    for (std::size_t k = 0; k < volts.size(); ++k) {
      counts[k] = stepper(volts[k]) * kCountsPerRadian;
    }
    benchmark::DoNotOptimize(counts.data());
  }
  double worst = 0;
  for (std::size_t k = 0; k < counts.size(); ++k) {
    worst = std::max(worst, std::abs(counts[k] - truth[k]));
  }
  state.SetLabel(histories()[which].name);
  state.counters["error_counts"] = worst;
  state.counters["tick"] = benchmark::Counter(
      static_cast<double>(volts.size()),
      benchmark::Counter::kIsIterationInvariantRate | benchmark::Counter::kInvert);
}

void plant(benchmark::State& state, bool every_term) {
  const auto axis = axis_of(every_term);
  const tests::Bench at_start(axis, kStart_m);  // its modes are built once, not every run
  const auto stepper = [&at_start] {
    return [bench = at_start](double volts) mutable {
      bench.input.command_V = volts;
      bench.tick();
      return bench.segments[bench.segments.size() - 1].end_angle_rad;
    };
  };
  run(state, stepper, every_term);
}

void plant_nominal(benchmark::State& state) {
  plant(state, false);
}
void plant_with_every_optional_term(benchmark::State& state) {
  plant(state, true);
}

// The equations of docs/theory/plant.md with smoothed friction and no events.
struct SmoothedAxis {
  emulator::AxisParameters p = tests::nominal_y();
  emulator::DerivedMechanics m = emulator::derive(p);
  double smoothing_rad_per_s = 0.05;
  double set_point_A = 0;

  [[nodiscard]] double rails_N(double x) const {
    const double share = 1 - std::abs(x - 1.976) / 1.976;
    return 1.6e-3 / m.metres_per_motor_rad * std::max(0.0, share);
  }
  [[nodiscard]] static double dry(const emulator::DryFriction& f, double v, double smoothing,
                                  double extra) {
    const double ratio = v * f.inverse_speed;
    return std::tanh(v / smoothing) * (f.coulomb + f.excess * std::exp(-ratio * ratio) + extra);
  }
  void operator()(const State& y, State& rate, double /*t*/) const {
    const double r = m.metres_per_motor_rad;
    const double demanded = m.proportional_gain_V_per_A * (set_point_A - y[0]) + y[1];
    const double terminal = std::clamp(demanded, -10.8, 10.8);
    rate[0] = (terminal - p.winding.resistance_ohm * y[0] - p.torque_constant_Nm_per_A * y[3]) /
              (p.winding.inductance_H + p.winding.choke_inductance_H);
    rate[1] = (terminal - y[1]) * m.integral_gain_V_per_A_s / m.proportional_gain_V_per_A;
    const double transmission = m.transmission_stiffness_N_per_m * (r * y[2] - y[4]) +
                                m.transmission_damping_N_s_per_m * (r * y[3] - y[5]);
    rate[2] = y[3];
    rate[3] = (p.torque_constant_Nm_per_A * y[0] - m.motor_viscous_Nm_s_per_rad * y[3] -
               r * transmission - dry(m.motor, y[3], smoothing_rad_per_s, 0)) /
              m.motor_inertia_kg_m2;
    rate[4] = y[5];
    rate[5] = (transmission - m.carriage_viscous_N_s_per_m * y[5] -
               dry(m.carriage, y[5], r * smoothing_rad_per_s, rails_N(y[4]))) /
              m.carriage_mass_kg;
    rate[6] = 0;  // warmth: a nominal axis has none
  }
  [[nodiscard]] State start() const {
    return {0, 0, kStart_m / m.metres_per_motor_rad, 0, kStart_m, 0, 0};
  }
  void take(double volts) {
    set_point_A =
        std::clamp(p.amplifier_gain_A_per_V * volts, -p.current_limit_A, p.current_limit_A);
  }
};

void odeint_rk4(benchmark::State& state, int substeps, double smoothing_rad_per_s) {
  run(state, [=] {
    SmoothedAxis axis;
    axis.smoothing_rad_per_s = smoothing_rad_per_s;
    return [=, y = axis.start(), rk4 = odeint::runge_kutta4<State>()](double volts) mutable {
      axis.take(volts);
      for (int i = 0; i < substeps; ++i) {
        rk4.do_step(std::cref(axis), y, 0.0, 1e-4 / substeps);
      }
      return y[2];
    };
  });
}

void odeint_rk4_100us(benchmark::State& state) {
  odeint_rk4(state, 1, 0.05);
}
void odeint_rk4_10us(benchmark::State& state) {
  odeint_rk4(state, 10, 0.005);
}

// As fine as is still worth running: what the smoothing leaves is not for the step to remove.
void odeint_rk4_2us(benchmark::State& state) {
  odeint_rk4(state, 50, 0.001);
}

// Event-located integrators run from one change of the command to the next in one go, as they like
// it best; the error is taken there. `digits`: tolerance 10^-digits.
template <typename Advance>
void from_change_to_change(benchmark::State& state, const Advance& advance) {
  const auto& volts = histories()[0].volts;
  const auto& truth = truth_counts(0, false);
  double worst = 0;
  for (auto _ : state) {
    AxisOracle oracle(tests::nominal_y(), kStart_m,
                      std::pow(10.0, -static_cast<double>(state.range(0))));
    for (std::size_t k = 0; k < volts.size();) {
      std::size_t end = k;
      while (end < volts.size() && volts[end] == volts[k]) {
        ++end;
      }
      advance(oracle, AxisOracle::Input{.command_V = volts[k]},
              1e-4 * static_cast<double>(end - k));
      worst = std::max(worst, std::abs(oracle.motor_counts() - truth[end - 1]));
      k = end;
    }
  }
  state.SetLabel(histories()[0].name);
  state.counters["error_counts"] = worst;
  state.counters["tick"] = benchmark::Counter(
      static_cast<double>(volts.size()),
      benchmark::Counter::kIsIterationInvariantRate | benchmark::Counter::kInvert);
}

void dopri5_with_events(benchmark::State& state) {
  from_change_to_change(state, [](AxisOracle& oracle, const AxisOracle::Input& in, double s) {
    oracle.advance(in, s);
  });
}

void cvode_with_events(benchmark::State& state) {
  from_change_to_change(state, [](AxisOracle& oracle, const AxisOracle::Input& in, double s) {
    oracle.advance_by_cvode(in, s);
  });
}

BENCHMARK(plant_nominal)->DenseRange(0, 5)->Unit(benchmark::kMillisecond);
BENCHMARK(plant_with_every_optional_term)->DenseRange(0, 5)->Unit(benchmark::kMillisecond);
BENCHMARK(odeint_rk4_100us)->DenseRange(0, 5)->Unit(benchmark::kMillisecond);
BENCHMARK(odeint_rk4_10us)->Arg(0)->Unit(benchmark::kMillisecond);
BENCHMARK(odeint_rk4_2us)->Arg(0)->Unit(benchmark::kMillisecond)->Iterations(1);
BENCHMARK(dopri5_with_events)->Arg(6)->Unit(benchmark::kMillisecond);
BENCHMARK(cvode_with_events)->Arg(6)->Arg(8)->Arg(10)->Unit(benchmark::kMillisecond);

}  // namespace
}  // namespace towbench
