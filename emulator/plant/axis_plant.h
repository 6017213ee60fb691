// One axis of the carriage, stepped at 10 kHz: amplifier, winding, gear, elastic chain, friction,
// hard ends. Pure: the next state follows from parameters, state and input alone.
#pragma once

#include <cstdint>

#include "core/bounded_vector.h"
#include "core/realtime.h"
#include "emulator/plant/axis_forces.h"
#include "emulator/plant/axis_parameters.h"

namespace towbench::emulator {

// Constant over one step.
struct AxisInput {
  double command_V = 0;  // at the amplifier's differential input, + drives towards max
  double supply_V = 12.0;
  double carriage_force_N = 0;     // external, + towards max (water, cross-axis, a hand)
  bool amplifier_enabled = false;  // false: no current flows
};

struct AxisState {
  double current_A = 0;
  double current_integral_V = 0;  // of the amplifier's PI loop
  double motor_angle_rad = 0;     // 0 where the encoder count is 0
  double motor_speed_rad_per_s = 0;
  double carriage_m = 0;  // 0 where the chain is relaxed at motor angle 0
  double carriage_speed_m_per_s = 0;
};

// A piece of a step without an event inside: cubic Hermite between its ends is exact to well below
// 1e-3 encoder counts.
struct MotionSegment {
  double start_s = 0;  // from the start of the step
  double end_s = 0;
  double start_angle_rad = 0;
  double start_speed_rad_per_s = 0;
  double end_angle_rad = 0;
  double end_speed_rad_per_s = 0;
};

inline constexpr std::size_t kMaxSegmentsPerStep = 16;
using MotionSegments = core::BoundedVector<MotionSegment, kMaxSegmentsPerStep>;

// First touch of a hard end inside a step.
struct HardEndContact {
  bool occurred = false;
  bool at_max = false;
  double time_s = 0;  // from the start of the step
  double speed_m_per_s = 0;
  double energy_J = 0;  // kinetic, of carriage and reflected drive
};

class AxisPlant {
 public:
  // Parameters are valid (the fixture reader refuses others). Starts at rest, chain relaxed.
  AxisPlant(const AxisParameters& parameters, double carriage_m);

  // Advances by core::kPlantTick_s. `segments` describes the motor shaft during the step.
  TOWBENCH_REALTIME void step(const AxisInput& input, MotionSegments& segments) noexcept;

  [[nodiscard]] const AxisState& state() const noexcept { return state_; }
  [[nodiscard]] const HardEndContact& contact() const noexcept { return contact_; }
  // Friction, chain and motor torque at the end of the last step, for truth.csv.
  [[nodiscard]] const AxisForces& forces() const noexcept { return forces_; }

 private:
  AxisState state_;
  HardEndContact contact_;
  AxisForces forces_;
};

}  // namespace towbench::emulator
