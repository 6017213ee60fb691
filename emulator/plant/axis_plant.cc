#include "emulator/plant/axis_plant.h"

#include "emulator/plant/event_search.h"
#include "emulator/plant/transitions.h"
#include "emulator/plant/warming.h"

namespace towbench::emulator {
namespace {

double clamp(double value, double limit) noexcept {
  if (value > limit) {
    return limit;
  }
  return value < -limit ? -limit : value;
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

// Whether the middle speeds taken for friction were off by so much that it shows: by 1e-4 of the
// Stribeck speed, and at a speed where friction depends on it: with optional terms at any.
bool prediction_failed(const AxisModel& model, double motor, double motor_miss, double carriage,
                       double carriage_miss) noexcept {
  constexpr double kTolerance = 1e-4;
  const auto failed = [&](const DryFriction& law, double speed, double miss) {
    return std::fabs(miss) * law.inverse_speed > kTolerance &&
           (model.has_terms || !model.stribeck.has_faded(std::fabs(speed) * law.inverse_speed));
  };
  return failed(model.mechanics.motor, motor, motor_miss) ||
         failed(model.mechanics.carriage, carriage, carriage_miss);
}

// r theta + delta(theta) = x; a real wheel differs little from a circle.
double angle_of_relaxed_transmission(const AxisModel& model, double carriage_m) noexcept {
  const double r = model.mechanics.metres_per_motor_rad;
  double angle_rad = carriage_m / r;
  if (model.wheel.present()) {
    constexpr int kRounds = 60;
    for (int i = 0; i < kRounds; ++i) {
      angle_rad = (carriage_m - model.wheel(model.sine, angle_rad).offset_m) / r;
    }
  }
  return angle_rad;
}

// From the speeds at z to the means over the tick to `next`, which the travelled way gives exactly:
// where the current turns inside the tick, the mean is not half-way.
HalfChange to_mean_speeds(const AxisModel& model, const StateVector& z,
                          const StateVector& next) noexcept {
  const double per_s = 1.0 / model.tick_s;
  const double travel_m = carriage_position_m(model, next) - carriage_position_m(model, z);
  return {.motor_rad_per_s = per_s * (next[kMotorAngle] - z[kMotorAngle]) - z[kMotorSpeed],
          .carriage_m_per_s = per_s * travel_m - z[kCarriageSpeed]};
}

// Where the middle of the coming tick will be, if speeds change as in the tick before.
MiddleOfMotion predicted_middle(const AxisModel& model, const StateVector& z,
                                const HalfChange& change) noexcept {
  const double half_s = 0.5 * model.tick_s;
  const double w = z[kMotorSpeed];
  const double v = z[kCarriageSpeed];
  return {
      .motor_rad = z[kMotorAngle] + half_s * (w + 0.5 * change.motor_rad_per_s),
      .motor_rad_per_s = w + change.motor_rad_per_s,
      .carriage_m = carriage_position_m(model, z) + half_s * (v + 0.5 * change.carriage_m_per_s),
      .carriage_m_per_s = v + change.carriage_m_per_s,
      .travel_rad = model.tick_s * (w + change.motor_rad_per_s)};
}

}  // namespace

AxisPlant::AxisPlant(const AxisParameters& parameters, double carriage_m, double tick_s)
    : model_(std::make_shared<const AxisModel>(parameters, tick_s)) {
  const AxisModel& model = *model_;
  z_[kMotorAngle] = angle_of_relaxed_transmission(model, carriage_m);
  z_[kStretch] = model.mechanics.metres_per_motor_rad * z_[kMotorAngle] - carriage_m;
  situation_.motor_anchor_rad = z_[kMotorAngle];
  situation_.carriage_anchor_m = carriage_m;
  situation_.regime.transmission =
      model.play.has_gap() ? TransmissionContact::kOpen : TransmissionContact::kTaut;
  situation_.transmission =
      transmission_law(model.mechanics, model.play, situation_.regime.transmission, 0.0);
  take(input_);
}

void AxisPlant::enter_mode() noexcept {
  mode_index_ = mode_of(situation_.regime).index();
  mode_ = &model_->ticks[mode_index_];
  plain_ = prepare_plain_tick(*model_, situation_);
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
  const CableParameters& cable = axis.disturbances.cable;
  held.carriage_force_N = input.carriage_force_N + model_->mechanics.tilt_force_N +
                          cable.stiffness_N_per_m * cable.reference_m;
  input_ = input;
  // Clear of the ends and without optional terms only the drive answers to an input, and a body
  // that stands to an outside force.
  if (plain_.possible) {
    const Drive drive = situation_.regime.drive;
    const double sign = situation_.regime.drive_sign;
    settle_drive(*model_, situation_, z_);
    const bool same_limit = drive != Drive::kLimited || situation_.regime.drive_sign == sign;
    if (situation_.regime.drive == drive && same_limit &&
        renew_plain_tick(*model_, situation_, z_, plain_)) {
      return;
    }
  }
  settle(*model_, situation_, z_);
  enter_mode();
}

void AxisPlant::step(const AxisInput& input, MotionSegments& segments) noexcept {
  segments.clear();
  contact_.occurred = false;
  if (!(input == input_)) {
    take(input);
  }
  if (plain_.still) {
    append(segments, 0.0, model_->tick_s, z_, z_);
    return;
  }
  StateVector next;
  if (plain_.possible &&
      step_plainly(*model_, plain_, situation_.position_interval, half_change_, z_, next)) {
    append(segments, 0.0, model_->tick_s, z_, next);
    plain_.still = stands(plain_) && next == z_;
    z_ = next;
    return;
  }
  if (!step_without_event(segments)) {
    step_through_events(segments);
  }
}

// Dry friction at the middle of a piece of motion, where it stands for the piece's mean to second
// order in its length.
[[gnu::always_inline]] inline void AxisPlant::update_friction(double motor_rad_per_s,
                                                              double carriage_m_per_s,
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

[[gnu::always_inline]] inline void AxisPlant::hold_middle_of_tick(
    const HalfChange& change) noexcept {
  const AxisModel& model = *model_;
  if (model.has_terms) {
    hold_terms(model, situation_, predicted_middle(model, z_, change));
    return;
  }
  update_friction(z_[kMotorSpeed] + change.motor_rad_per_s,
                  z_[kCarriageSpeed] + change.carriage_m_per_s,
                  carriage_position_m(model, z_) + 0.5 * model.tick_s * z_[kCarriageSpeed]);
}

// The middle of the flow's first part.
void AxisPlant::hold_middle_of(const TaylorFlow& flow, double fraction, double span_s) noexcept {
  const AxisModel& model = *model_;
  const StateVector end = flow.at(fraction);
  const double motor_rad_per_s = 0.5 * (z_[kMotorSpeed] + end[kMotorSpeed]);
  const double carriage_m_per_s = 0.5 * (z_[kCarriageSpeed] + end[kCarriageSpeed]);
  if (model.has_terms) {
    MiddleOfMotion middle = motion_at(model, flow.at(0.5 * fraction), fraction * span_s);
    middle.motor_rad_per_s = motor_rad_per_s;
    middle.carriage_m_per_s = carriage_m_per_s;
    hold_terms(model, situation_, middle);
    return;
  }
  update_friction(motor_rad_per_s, carriage_m_per_s,
                  0.5 * (carriage_position_m(model, z_) + carriage_position_m(model, end)));
}

// The whole tick by its matrices. Friction is taken where the tick's middle will be if the speed
// changes as in the tick before; where that turns out wrong and friction depends on speed, what was
// missed is added afterwards, as a linear mode allows. False, and nothing changed but friction
// levels, when an event lies inside.
bool AxisPlant::step_without_event(MotionSegments& segments) noexcept {
  const AxisModel& model = *model_;
  const DiscreteMode& mode = *mode_;
  hold_middle_of_tick(half_change_);
  const InputVector inputs = held_inputs(model, situation_);
  StateVector next = emulator::step(mode, z_, inputs);
  const HalfChange change{.motor_rad_per_s = 0.5 * (next[kMotorSpeed] - z_[kMotorSpeed]),
                          .carriage_m_per_s = 0.5 * (next[kCarriageSpeed] - z_[kCarriageSpeed])};
  if (prediction_failed(model, z_[kMotorSpeed] + half_change_.motor_rad_per_s,
                        change.motor_rad_per_s - half_change_.motor_rad_per_s,
                        z_[kCarriageSpeed] + half_change_.carriage_m_per_s,
                        change.carriage_m_per_s - half_change_.carriage_m_per_s)) {
    hold_middle_of_tick(model.has_terms ? to_mean_speeds(model, z_, next) : change);
    const InputVector refined = held_inputs(model, situation_);
    add_input(mode, kMotorTorque, refined[kMotorTorque] - inputs[kMotorTorque], next);
    add_input(mode, kCarriageForce, refined[kCarriageForce] - inputs[kCarriageForce], next);
  }
  if (!regime_holds(model, situation_, next)) {
    return false;
  }
  half_change_ = change;
  append(segments, 0.0, model.tick_s, z_, next);
  warm(z_, next, model.tick_s);
  z_ = next;
  return true;
}

// The flow for the rest of the tick, with what is held taken in its middle. Expanded twice only
// where the first guess of that was off.
TaylorFlow AxisPlant::flow_from_here(double span_s) noexcept {
  const AxisModel& model = *model_;
  const ContinuousMode& mode = model.flows[mode_index_];
  if (model.has_terms) {
    hold_terms(model, situation_, motion_at(model, z_, span_s));
  } else {
    update_friction(z_[kMotorSpeed], z_[kCarriageSpeed], carriage_position_m(model, z_));
  }
  const InputVector inputs = held_inputs(model, situation_);
  TaylorFlow flow(mode, z_, inputs, span_s);
  hold_middle_of(flow, 1.0, span_s);
  const InputVector refined = held_inputs(model, situation_);
  constexpr double kNegligible = 1e-6;  // of the body's break-away level
  const bool good = std::fabs(refined[kMotorTorque] - inputs[kMotorTorque]) <=
                        kNegligible * model.mechanics.motor.breakaway &&
                    std::fabs(refined[kCarriageForce] - inputs[kCarriageForce]) <=
                        kNegligible * model.mechanics.carriage.breakaway;
  if (!good) {
    flow = TaylorFlow(mode, z_, refined, span_s);
  }
  return flow;
}

void AxisPlant::warm(const StateVector& before, const StateVector& after,
                     double duration_s) noexcept {
  const FrictionWarming& law = model_->parameters.friction.options.warming;
  if (law.depth == 0) {
    return;
  }
  const double dissipated_J = dissipated_by_dry_friction_J(
      situation_, after[kMotorAngle] - before[kMotorAngle],
      carriage_position_m(*model_, after) - carriage_position_m(*model_, before));
  const double cooler = warmth_;
  warmth_ = warmed(law, warmth_, dissipated_J, duration_s);
  // The next tick's middle, if it warms as this one did.
  situation_.terms.level_scale = level_scale(law, warmth_ + 0.5 * (warmth_ - cooler));
}

void AxisPlant::record_contact(double time_s, double sign) noexcept {
  const DerivedMechanics& m = model_->mechanics;
  const double v = z_[kCarriageSpeed];
  const double w = z_[kMotorSpeed];
  const double carriage_J =
      model_->parameters.elasticity.rigid ? 0.0 : 0.5 * m.carriage_mass_kg * v * v;
  contact_ = {.occurred = true,
              .at_max = sign > 0,
              .time_s = time_s,
              .speed_m_per_s = v,
              .energy_J = carriage_J + 0.5 * m.motor_inertia_kg_m2 * w * w};
}

// Where the first event ends the flow. Optional terms were held in the middle of all that is left
// of the tick: they are moved to the middle of the piece before the event, and the event with them.
Crossing AxisPlant::first_piece(double span_s, TaylorFlow& flow) noexcept {
  const AxisModel& model = *model_;
  const Crossing crossing = first_event(model, situation_, flow);
  if (!crossing.found || !model.has_terms) {
    return crossing;
  }
  hold_middle_of(flow, crossing.fraction, span_s);
  flow = TaylorFlow(model.flows[mode_index_], z_, held_inputs(model, situation_), span_s);
  return first_event(model, situation_, flow);
}

void AxisPlant::step_through_events(MotionSegments& segments) noexcept {
  const AxisModel& model = *model_;
  double time_s = 0;
  // The last segment is kept for the rest of the tick, which then runs without looking for events:
  // so many in one tick are chatter at the edge of rounding.
  for (std::size_t piece = 0; piece < kMaxSegmentsPerStep; ++piece) {
    const double span_s = model.tick_s - time_s;
    TaylorFlow flow = flow_from_here(span_s);
    const Crossing crossing =
        piece + 1 < kMaxSegmentsPerStep ? first_piece(span_s, flow) : Crossing{};
    const double end_s = crossing.found ? time_s + crossing.fraction * span_s : model.tick_s;
    const StateVector start = z_;
    z_ = flow.at(crossing.fraction);
    warm(start, z_, end_s - time_s);
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
    enter_mode();
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
