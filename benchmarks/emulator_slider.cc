// The axis against a general rigid-body engine: ODE's slider joint, the usual way to get a carriage
// into a simulation. One mass of the carriage's size under a constant force, 100 us steps, one
// second: x = F t^2 / (2 M). Each rate stands beside its error in encoder counts at the end.
//
// ODE's slider has neither winding nor amplifier nor a friction law with break-away; the nominal
// axis, which has, runs beside it.
#include <cmath>
#include <memory>
#include <type_traits>

#include <benchmark/benchmark.h>
#include <ode/ode.h>

#include "emulator/plant/axis_plant.h"

namespace {

using namespace towbench;

constexpr double kMass_kg = 6.0;
constexpr double kForce_N = 3.0;
constexpr int kStepsPerSecond = 10'000;
constexpr double kCountsPerMetre = 445'345.0;  // (3.42)

double error_counts(double position_m) {
  const double exact_m = 0.5 * kForce_N / kMass_kg;
  return std::fabs(position_m - exact_m) * kCountsPerMetre;
}

// --- ODE -----------------------------------------------------------------------------------------

template <typename T, void (*kDestroy)(T)>
struct Destroyer {
  using pointer = T;
  void operator()(T thing) const { kDestroy(thing); }
};

class OdeLibrary {
 public:
  OdeLibrary() { dInitODE(); }
  ~OdeLibrary() { dCloseODE(); }
  OdeLibrary(const OdeLibrary&) = delete;
  OdeLibrary& operator=(const OdeLibrary&) = delete;
};

class OdeSlider {
 public:
  explicit OdeSlider(int (*stepper)(dWorldID, dReal)) : world_(dWorldCreate()), stepper_(stepper) {
    body_ = dBodyCreate(world_.get());
    dMass mass;
    dMassSetBoxTotal(&mass, kMass_kg, 0.2, 0.2, 0.2);
    dBodySetMass(body_, &mass);
    const dJointID slider = dJointCreateSlider(world_.get(), nullptr);
    dJointAttach(slider, body_, nullptr);
    dJointSetSliderAxis(slider, 1, 0, 0);
  }
  void step() {
    dBodyAddForce(body_, kForce_N, 0, 0);
    stepper_(world_.get(), core::kPlantTick_s);
  }
  [[nodiscard]] double position_m() const { return dBodyGetPosition(body_)[0]; }

 private:
  static OdeLibrary& library() {
    static OdeLibrary library;
    return library;
  }
  OdeLibrary& library_ = library();
  std::unique_ptr<std::remove_pointer_t<dWorldID>, Destroyer<dWorldID, dWorldDestroy>> world_;
  int (*stepper_)(dWorldID, dReal);
  dBodyID body_ = nullptr;  // the world's, as is the joint
};

void ode(benchmark::State& state, int (*step)(dWorldID, dReal)) {
  OdeSlider judged(step);
  for (int i = 0; i < kStepsPerSecond; ++i) {
    judged.step();
  }
  OdeSlider slider(step);
  for (auto _ : state) {
    slider.step();
  }
  state.counters["error_counts"] = error_counts(judged.position_m());
}
void ode_slider(benchmark::State& state) {
  ode(state, dWorldStep);
}
void ode_slider_quick(benchmark::State& state) {
  ode(state, dWorldQuickStep);
}
BENCHMARK(ode_slider);
BENCHMARK(ode_slider_quick);

// --- the axis ------------------------------------------------------------------------------------

emulator::AxisParameters mere_mass() {
  emulator::AxisParameters axis;
  const double r = axis.output_radius_m / axis.gear_ratio;
  axis.inertia_kg_m2 = kMass_kg * r * r;
  axis.rotor_inertia_kg_m2 = 0.2 * axis.inertia_kg_m2;
  axis.viscous_friction_Nm_s_per_rad = 0;
  axis.coulomb_friction_Nm = 0;
  axis.friction.breakaway_Nm = 0;
  axis.elasticity.rigid = true;
  axis.hard_ends.fitted = false;
  return axis;
}

void axis_as_mere_mass(benchmark::State& state) {
  const emulator::AxisInput input{.carriage_force_N = kForce_N};
  emulator::MotionSegments segments;
  emulator::AxisPlant judged(mere_mass(), 0.0);
  for (int i = 0; i < kStepsPerSecond; ++i) {
    judged.step(input, segments);
  }
  emulator::AxisPlant axis(mere_mass(), 0.0);
  for (auto _ : state) {
    axis.step(input, segments);
    benchmark::DoNotOptimize(segments);
  }
  state.counters["error_counts"] = error_counts(judged.state().carriage_m);
}
BENCHMARK(axis_as_mere_mass);

// Winding, current loop, elastic transmission, both friction laws, to and fro about the middle.
void axis_nominal_in_motion(benchmark::State& state) {
  emulator::AxisParameters parameters;
  parameters.hard_ends.fitted = false;
  emulator::AxisPlant axis(parameters, 0.0);
  emulator::AxisInput input{.amplifier_enabled = true};
  emulator::MotionSegments segments;
  int tick = 0;
  for (auto _ : state) {
    if (tick++ % 10 == 0) {
      input.command_V = axis.state().carriage_m < 0.0 ? 1.5 : -1.5;
    }
    axis.step(input, segments);
    benchmark::DoNotOptimize(segments);
  }
}
BENCHMARK(axis_nominal_in_motion);

}  // namespace
