#include "emulator/plant/axis_plant.h"

#include "emulator/plant/guards.h"
#include "emulator/plant/transitions.h"

namespace towbench::emulator {
namespace {

struct Crossing {
  Event event = Event::kMotorStops;
  double sign = 0;
  double fraction = 1.0;
  bool found = false;
};

double clamp(double value, double limit) noexcept {
  if (value > limit) {
    return limit;
  }
  return value < -limit ? -limit : value;
}

// The margin that turns negative first along the flow. Margins are looked at in the middle and at
// the end: what dips below zero and comes back within half a tick is taken for rounding.
Crossing first_event(const AxisModel& model, const Situation& s, const TaylorFlow& flow) noexcept {
  struct Suspect {
    bool leaves = false;
    double last = 1.0;
  };
  constexpr std::size_t kMostMargins = 8;
  std::array<Suspect, kMostMargins> suspects{};
  bool any = false;
  for (const double fraction : {1.0, 0.5}) {
    std::size_t i = 0;
    visit_guards(model, s, flow.at(fraction), 1.0, [&](Event, double, double margin) {
      if (margin < 0) {
        suspects[i] = {.leaves = true, .last = fraction};
        any = true;
      }
      ++i;
    });
  }
  Crossing first;
  if (!any) {
    return first;
  }
  std::array<ScalarSeries, kMostMargins> series;
  for (int k = 0; k <= flow.terms(); ++k) {
    std::size_t i = 0;
    visit_guards(
        model, s, flow.coefficient(k), k == 0 ? 1.0 : 0.0,
        [&](Event, double, double margin) { series[i++][static_cast<std::size_t>(k)] = margin; });
  }
  std::size_t i = 0;
  visit_guards(model, s, flow.coefficient(0), 1.0, [&](Event event, double sign, double) {
    if (suspects[i].leaves) {
      const double fraction = first_crossing(series[i], flow.terms(), suspects[i].last);
      if (!first.found || fraction < first.fraction) {
        first = {.event = event, .sign = sign, .fraction = fraction, .found = true};
      }
    }
    ++i;
  });
  return first;
}

void append(MotionSegments& segments, double start_s, double end_s, const StateVector& start,
            const StateVector& end) noexcept {
  core::check(segments.push_back({.start_s = start_s,
                             .end_s = end_s,
                             .start_angle_rad = start[kMotorAngle],
                             .start_speed_rad_per_s = start[kMotorSpeed],
                             .end_angle_rad = end[kMotorAngle],
                             .end_speed_rad_per_s = end[kMotorSpeed]}));
}

// Whether dry friction does not depend on speed here, for a tick at least.
bool friction_has_settled(const AxisModel& model, const Situation& s,
                          const StateVector& z) noexcept {
  const auto faded = [&](const DryFriction& law, double direction, double speed) {
    return direction == 0 || model.stribeck.has_faded(std::fabs(speed) * law.inverse_speed);
  };
  return faded(model.mechanics.motor, s.regime.motor_direction, z[kMotorSpeed]) &&
         faded(model.mechanics.carriage, s.regime.carriage_direction, z[kCarriageSpeed]);
}

}  // namespace

AxisPlant::AxisPlant(const AxisParameters& parameters, double carriage_m, double tick_s)
    : model_(std::make_shared<const AxisModel>(parameters, tick_s)) {
  z_[kMotorAngle] = carriage_m / model_->mechanics.metres_per_radian;
  settle(*model_, situation_, z_);
  mode_index_ = mode_of(situation_.regime).index();
}

void AxisPlant::take(const AxisInput& input) noexcept {
  const auto& axis = model_->parameters;
  HeldInput& held = situation_.held;
  held.enabled = input.amplifier_enabled;
  held.supply_V = input.supply_V;
  held.limit_V = axis.amplifier.output_limit_ratio * input.supply_V;
  held.set_point_A = clamp(axis.amplifier_gain_A_per_V * input.command_V, axis.current_limit_A);
  held.command_terminal_V =
      clamp(axis.amplifier.voltage_gain_V_per_V * input.command_V, held.limit_V);
  held.carriage_force_N = input.carriage_force_N;
  input_ = input;
  settle(*model_, situation_, z_);
  mode_index_ = mode_of(situation_.regime).index();
}

void AxisPlant::step(const AxisInput& input, MotionSegments& segments) noexcept {
  segments.clear();
  contact_.occurred = false;
  if (!(input == input_)) {
    take(input);
  }
  if (!step_without_event(segments)) {
    step_through_events(segments);
  }
}

// Dry friction at the middle of a piece of motion, where it stands for the piece's mean to second
// order in its length.
void AxisPlant::update_friction(double motor_rad_per_s, double carriage_m_per_s,
                                double carriage_m) noexcept {
  const AxisModel& model = *model_;
  Situation& s = situation_;
  if (model.motor_is_dry && s.regime.motor_direction != 0) {
    s.motor_friction_Nm = motor_level_Nm(model, motor_rad_per_s, carriage_m, s.position_interval);
  }
  if (model.carriage_is_dry && s.regime.carriage_direction != 0) {
    s.carriage_friction_N =
        carriage_level_N(model, carriage_m_per_s, carriage_m, s.position_interval);
  }
}

// The whole tick by its matrices. Friction is taken where the tick's middle will be if the speed
// stays; where it depends on speed, what that missed is added afterwards, as a linear mode allows.
// False, and nothing changed but friction levels, when an event lies inside.
bool AxisPlant::step_without_event(MotionSegments& segments) noexcept {
  const AxisModel& model = *model_;
  const DiscreteMode& mode = model.ticks[mode_index_];
  const double half_tick_s = 0.5 * model.tick_s;
  const double middle_m = carriage_position_m(model, z_) + half_tick_s * z_[kCarriageSpeed];
  update_friction(z_[kMotorSpeed], z_[kCarriageSpeed], middle_m);
  const InputVector inputs = held_inputs(model, situation_);
  StateVector next = emulator::step(mode, z_, inputs);
  if (!friction_has_settled(model, situation_, z_)) {
    update_friction(0.5 * (z_[kMotorSpeed] + next[kMotorSpeed]),
                    0.5 * (z_[kCarriageSpeed] + next[kCarriageSpeed]), middle_m);
    const InputVector refined = held_inputs(model, situation_);
    add_input(mode, kMotorTorque, refined[kMotorTorque] - inputs[kMotorTorque], next);
    add_input(mode, kCarriageForce, refined[kCarriageForce] - inputs[kCarriageForce], next);
  }
  if (!regime_holds(model, situation_, next)) {
    return false;
  }
  append(segments, 0.0, model.tick_s, z_, next);
  z_ = next;
  return true;
}

TaylorFlow AxisPlant::flow_from_here(double span_s) noexcept {
  const ContinuousMode& mode = model_->flows[mode_index_];
  const TaylorFlow guess(mode, z_, held_inputs(*model_, situation_), span_s);
  const StateVector end = guess.at(1.0);
  update_friction(0.5 * (z_[kMotorSpeed] + end[kMotorSpeed]),
                  0.5 * (z_[kCarriageSpeed] + end[kCarriageSpeed]),
                  0.5 * (carriage_position_m(*model_, z_) + carriage_position_m(*model_, end)));
  return {mode, z_, held_inputs(*model_, situation_), span_s};
}

void AxisPlant::record_contact(double time_s, double sign) noexcept {
  const DerivedMechanics& m = model_->mechanics;
  const double v = z_[kCarriageSpeed];
  const double w = z_[kMotorSpeed];
  const double carriage_J = model_->parameters.chain.rigid ? 0.0 : 0.5 * m.carriage_mass_kg * v * v;
  contact_ = {.occurred = true,
              .at_max = sign > 0,
              .time_s = time_s,
              .speed_m_per_s = v,
              .energy_J = carriage_J + 0.5 * m.motor_inertia_kg_m2 * w * w};
}

void AxisPlant::step_through_events(MotionSegments& segments) noexcept {
  const AxisModel& model = *model_;
  double time_s = 0;
  // The last segment is kept for the rest of the tick, which then runs without looking for events:
  // so many in one tick are chatter at the edge of rounding.
  for (std::size_t piece = 0; piece < kMaxSegmentsPerStep; ++piece) {
    const double span_s = model.tick_s - time_s;
    const TaylorFlow flow = flow_from_here(span_s);
    const Crossing crossing =
        piece + 1 < kMaxSegmentsPerStep ? first_event(model, situation_, flow) : Crossing{};
    const double end_s = crossing.found ? time_s + crossing.fraction * span_s : model.tick_s;
    const StateVector start = z_;
    z_ = flow.at(crossing.fraction);
    if (end_s > time_s) {
      append(segments, time_s, end_s, start, z_);
    }
    time_s = end_s;
    if (!crossing.found) {
      return;
    }
    if (crossing.event == Event::kEndReached && !contact_.occurred) {
      record_contact(time_s, crossing.sign);
    }
    cross(model, crossing.event, crossing.sign, situation_, z_);
    mode_index_ = mode_of(situation_.regime).index();
  }
}

AxisState AxisPlant::state() const noexcept {
  return {.current_A = z_[kCurrent],
          .current_integral_V = z_[kIntegral],
          .motor_angle_rad = z_[kMotorAngle],
          .motor_speed_rad_per_s = z_[kMotorSpeed],
          .carriage_m = carriage_position_m(*model_, z_),
          .carriage_speed_m_per_s = z_[kCarriageSpeed]};
}

}  // namespace towbench::emulator
