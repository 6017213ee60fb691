// One axis of the carriage, stepped at 10 kHz: amplifier, winding, gear, elastic transmission,
// friction, hard ends. Pure: the next state follows from parameters, state and input alone.
//
// Laws: axis_model.h (linear part), friction_law.h (dry friction), held_terms.h (optional laws),
// guards.h (what ends a regime).
// Between events the axis is linear and the step is exact; reversals, break-away, limits and
// contacts are located inside the step (docs/decisions/0002-friction-and-stepping.md).
//
// Left out: iron losses, brush drop, winding temperature, the diodes' conduction of a motor driven
// faster than the supply allows.
#pragma once

#include <cstdint>
#include <memory>

#include "core/bounded_vector.h"
#include "core/realtime.h"
#include "core/time.h"
#include "emulator/plant/axis_forces.h"
#include "emulator/plant/axis_parameters.h"
#include "emulator/plant/event_search.h"
#include "emulator/plant/held_terms.h"
#include "emulator/plant/plain_tick.h"
#include "emulator/plant/taylor_flow.h"

namespace towbench::emulator {

// Constant over one step.
struct AxisInput {
  double command_V = 0;  // at the amplifier's differential input, + drives towards max
  double supply_V = 12.0;
  double carriage_force_N = 0;     // external, + towards max (water, cross-axis, a hand)
  bool amplifier_enabled = false;  // false: current dies through the diodes, then none flows

  friend constexpr bool operator==(const AxisInput&, const AxisInput&) = default;
};

struct AxisState {
  double current_A = 0;
  double current_integral_V = 0;  // of the amplifier's PI loop
  double motor_angle_rad = 0;     // 0 where the encoder count is 0
  double motor_speed_rad_per_s = 0;
  double carriage_m = 0;  // 0 where the transmission is relaxed at motor angle 0
  double carriage_speed_m_per_s = 0;
};

// A piece of a step without an event inside: cubic Hermite between its ends is exact to about 1e-3
// encoder counts while the current slews, far better otherwise.
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
  // Parameters are consistent (axis_parameters.h; others abort). Starts at rest, transmission
  // relaxed. A tick other than the plant's own serves convergence studies.
  AxisPlant(const AxisParameters& parameters, double carriage_m,
            double tick_s = core::kPlantTick_s);

  // Between two steps both bodies are put further and faster, as one: what is bent or flows stays.
  TOWBENCH_REALTIME void displace(double by_m, double by_m_per_s) noexcept;

  // Advances by one tick. `segments` describes the motor shaft during it, without gaps.
  TOWBENCH_REALTIME void step(const AxisInput& input, MotionSegments& segments) noexcept;

  // Between two steps the transmission jumps a tooth: stretched by `by_m` less, as if the
  // motor stood so far back, while neither body moves. state() has the motor's angle by the
  // transmission, which from then on is not that of the shaft; the difference is returned, in rad.
  // A rigid transmission has no teeth to jump: 0.
  TOWBENCH_REALTIME [[nodiscard]] double skip_tooth(double by_m) noexcept;

  [[nodiscard]] AxisState state() const noexcept;
  // Of the last step.
  [[nodiscard]] const HardEndContact& contact() const noexcept { return contact_; }
  // At the end of the last step.
  [[nodiscard]] AxisForces forces() const noexcept;
  // Of the friction, 0 cold to 1 fully warm (warming.h).
  [[nodiscard]] double warmth() const noexcept { return warmth_; }

 private:
  void take(const AxisInput& input) noexcept;
  void enter_mode() noexcept;
  [[nodiscard]] bool step_without_event(MotionSegments& segments) noexcept;
  void step_through_events(MotionSegments& segments) noexcept;
  [[nodiscard]] TaylorFlow flow_from_here(double span_s) noexcept;
  void update_friction(double motor_rad_per_s, double carriage_m_per_s, double carriage_m) noexcept;
  void hold_middle_of_tick(const HalfChange& change) noexcept;
  void hold_middle_of(const TaylorFlow& flow, double fraction, double span_s) noexcept;
  [[nodiscard]] Crossing first_piece(double span_s, TaylorFlow& flow) noexcept;
  void warm(const StateVector& before, const StateVector& after, double duration_s) noexcept;
  void record_contact(double time_s, double sign) noexcept;

  std::shared_ptr<const AxisModel> model_;
  StateVector z_{};
  Situation situation_;
  std::size_t mode_index_ = 0;  // of situation_.regime
  const DiscreteMode* mode_ = nullptr;
  PlainTick plain_;
  HalfChange half_change_;
  double warmth_ = 0;  // 1: fully warm (warming.h)
  AxisInput input_;    // of the step before
  HardEndContact contact_;
};

}  // namespace towbench::emulator
