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

bool append(MotionSegments& segments, double start_s, double end_s, const StateVector& start,
            const StateVector& end) noexcept {
  return segments.push_back({.start_s = start_s,
                             .end_s = end_s,
                             .start_angle_rad = start[kMotorAngle],
                             .start_speed_rad_per_s = start[kMotorSpeed],
                             .end_angle_rad = end[kMotorAngle],
                             .end_speed_rad_per_s = end[kMotorSpeed]});
}

}  // namespace

AxisPlant::AxisPlant(const AxisParameters& parameters, double carriage_m, double tick_s)
    : model_(std::make_shared<const AxisModel>(parameters, tick_s)) {
  z_[kMotorAngle] = carriage_m / model_->mechanics.metres_per_radian;
  settle(*model_, situation_, z_);
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
void AxisPlant::update_friction(const StateVector& start, const StateVector& end) noexcept {
  const AxisModel& model = *model_;
  const double middle_m =
      0.5 * (carriage_position_m(model, start) + carriage_position_m(model, end));
  if (model.motor_is_dry && situation_.regime.motor_direction != 0) {
    situation_.motor_friction_Nm =
        motor_level_Nm(model, 0.5 * (start[kMotorSpeed] + end[kMotorSpeed]), middle_m);
  }
  if (model.carriage_is_dry && situation_.regime.carriage_direction != 0) {
    situation_.carriage_friction_N =
        carriage_level_N(model, 0.5 * (start[kCarriageSpeed] + end[kCarriageSpeed]), middle_m);
  }
}

// The whole tick by its matrices, with the friction of the tick before; the difference to the
// friction at this tick's middle is added afterwards, which a linear mode allows. False, and
// nothing changed but the friction levels, when an event lies inside.
bool AxisPlant::step_without_event(MotionSegments& segments) noexcept {
  const AxisModel& model = *model_;
  const Regime& regime = situation_.regime;
  const DiscreteMode& mode = model.ticks[mode_of(regime).index()];
  const double motor_before_Nm = situation_.motor_friction_Nm;
  const double carriage_before_N = situation_.carriage_friction_N;
  StateVector next = emulator::step(mode, z_, held_inputs(model, situation_));
  update_friction(z_, next);
  const double torque_Nm =
      -regime.motor_direction * (situation_.motor_friction_Nm - motor_before_Nm);
  const double force_N =
      -regime.carriage_direction * (situation_.carriage_friction_N - carriage_before_N);
  for (std::size_t row = 0; row < kStateCount; ++row) {
    next[row] +=
        mode.input[kMotorTorque][row] * torque_Nm + mode.input[kCarriageForce][row] * force_N;
  }
  if (!regime_holds(model, situation_, next)) {
    return false;
  }
  core::check(append(segments, 0.0, model.tick_s, z_, next));
  z_ = next;
  return true;
}

TaylorFlow AxisPlant::flow_from_here(double span_s) noexcept {
  const ContinuousMode& mode = model_->flows[mode_of(situation_.regime).index()];
  const TaylorFlow guess(mode, z_, held_inputs(*model_, situation_), span_s);
  update_friction(z_, guess.at(1.0));
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
      core::check(append(segments, time_s, end_s, start, z_));
    }
    time_s = end_s;
    if (!crossing.found) {
      return;
    }
    if (crossing.event == Event::kEndReached && !contact_.occurred) {
      record_contact(time_s, crossing.sign);
    }
    cross(model, crossing.event, crossing.sign, situation_, z_);
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
