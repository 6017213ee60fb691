#include <numbers>

#include "emulator/rig.h"

namespace towbench::emulator {

using core::Axis;

RigAxis::RigAxis(Axis axis, const RigAxisParameters& p, const Seeds& seeds,
                 const ForeignOutput* at_start)
    : command(p.command, seeds.ripple),
      plant_(p.plant, p.start_m, at_start),
      state_(plant_.state()),
      encoder_(p.encoder, p.encoder.side == EncoderSide::kLoad
                              ? state_.carriage_m * p.plant.gear_ratio / p.plant.output_radius_m
                              : state_.motor_angle_rad),
      disc_(p.encoder),
      wiring_(encoder_.levels()),
      hall_min_(p.hall_min, TravelEnd::kMin, protocol::hall_line(axis, false), p.start_m),
      hall_max_(p.hall_max, TravelEnd::kMax, protocol::hall_line(axis, true), p.start_m),
      faults_(gripped_kg(p.plant)),
      resistance_ohm_(p.plant.winding.resistance_ohm),
      torque_constant_Nm_per_A_(p.plant.torque_constant_Nm_per_A),
      motor_rad_per_m_(p.plant.gear_ratio / p.plant.output_radius_m),
      counts_per_rad_(static_cast<double>(p.encoder.counts_per_turn) / (2.0 * std::numbers::pi)),
      sees_load_(p.encoder.side == EncoderSide::kLoad),
      tells_count_(p.encoder.absolute) {
  EncoderParameters track = p.encoder;
  track.phase_deg = 90.0;
  track.pulse_width_deg = 180.0;
  const bool is_in_place =
      track.phase_deg == p.encoder.phase_deg && track.pulse_width_deg == p.encoder.pulse_width_deg;
  if (tells_count_ && !is_in_place) {
    count_track_.emplace(track);
  }
  if (p.home.fitted) {
    home_.emplace(p.home, protocol::home_line(axis), state_.carriage_m);
  }
  if (p.brake.fitted) {
    brake_.emplace(p.brake, p.plant, state_.carriage_m);
  }
  if (p.current_monitor.fitted) {
    current_monitor_.emplace(p.current_monitor, axis, seeds.current_monitor);
  }
}

void RigAxis::take_command(const Surroundings& around) noexcept {
  input_ = {.command_V = command.step(),
            .supply_V = around.supply_V,
            .carriage_force_N = around.external_N,
            .amplifier_enabled = enable_line && around.amplifier_may_drive};
  faults_.apply(state_, acceleration_m_per_s2_, input_);
  if (brake_) {
    input_.carriage_force_N +=
        brake_->step(brake_release_line && around.amplifier_may_drive, state_);
  }
  command_V_ = input_.command_V;
}

void RigAxis::move(core::Nanoseconds start_ns, const ForeignOutput& output,
                   LineChanges& changes) noexcept {
  const AxisState before = state_;
  plant_.step(input_, output, segments_);
  state_ = plant_.state();
  if (sees_load_) {
    follow_load(before, state_);
  } else if (skipped_rad_ != 0.0) {
    turn_shaft();
  }
  encoder_.step(segments_, edges_);
  wiring_.step(disc_.step(encoder_.levels(), edges_), edges_);
  const AxisState& after = state_;
  const CarriageMotion motion{.before_m = before.carriage_m,
                              .before_m_per_s = before.carriage_speed_m_per_s,
                              .after_m = after.carriage_m,
                              .after_m_per_s = after.carriage_speed_m_per_s};
  hall_min_.step(start_ns, motion, changes);
  hall_max_.step(start_ns, motion, changes);
  if (home_) {
    home_->step(start_ns, motion, changes);
  }
  acceleration_m_per_s2_ =
      (after.carriage_speed_m_per_s - before.carriage_speed_m_per_s) / core::kPlantTick_s;
  if (current_monitor_) {
    protocol::CurrentSample sample;
    const bool taken =
        current_monitor_->step(start_ns + core::kPlantTick_ns, after.current_A, sample);
    current_sample_ = taken ? std::optional(sample) : std::nullopt;
  }
}

// The encoder sits on the shaft.
void RigAxis::turn_shaft() noexcept {
  for (std::size_t i = 0; i < segments_.size(); ++i) {
    segments_[i].start_angle_rad += skipped_rad_;
    segments_[i].end_angle_rad += skipped_rad_;
  }
}

// The encoder sits on the load. Its place and speed at both ends of the tick: what happens between
// them, a hard end's touch above all, is smoothed over the tick.
void RigAxis::follow_load(const AxisState& before, const AxisState& after) noexcept {
  segments_.clear();
  (void)segments_.push_back(
      {.start_s = 0.0,
       .end_s = core::kPlantTick_s,
       .start_angle_rad = before.carriage_m * motor_rad_per_m_,
       .start_speed_rad_per_s = before.carriage_speed_m_per_s * motor_rad_per_m_,
       .end_angle_rad = after.carriage_m * motor_rad_per_m_,
       .end_speed_rad_per_s = after.carriage_speed_m_per_s * motor_rad_per_m_});
}

void RigAxis::fail(ScheduledEventKind kind, double value) noexcept {
  if (kind == ScheduledEventKind::kSlipDisc) {
    disc_.slip(static_cast<std::int64_t>(value), encoder_.count());
  } else if (kind == ScheduledEventKind::kTurnDisc) {
    disc_.turn(static_cast<std::int64_t>(value), encoder_.count());
  } else if (kind == ScheduledEventKind::kHoldAbsolute) {
    held_count_ = value != 0.0 ? std::optional(told_count()) : std::nullopt;
  } else if (kind == ScheduledEventKind::kSkipTooth) {
    skipped_rad_ += plant_.skip_tooth(value);
    state_ = plant_.state();
  } else if (kind == ScheduledEventKind::kStickBrake && brake_) {
    brake_->stick(value != 0.0);
  } else if (kind == ScheduledEventKind::kLoseBrake && brake_) {
    brake_->lose(value != 0.0, state_.carriage_m);
  } else {
    faults_.set(kind, value, state_, command_V_);
  }
}

double RigAxis::seen_rad() const noexcept {
  return sees_load_ ? state_.carriage_m * motor_rad_per_m_ : state_.motor_angle_rad + skipped_rad_;
}

std::int32_t RigAxis::told_count() const noexcept {
  const std::int64_t shaft =
      count_track_ ? count_track_->count_at(seen_rad() * counts_per_rad_) : encoder_.count();
  // A loose disc is off by what it slipped, however its lines are placed.
  const std::int64_t slipped = disc_.count_at(encoder_.count()) - encoder_.count();
  return held_count_.value_or(static_cast<std::int32_t>(shaft + slipped));
}

double RigAxis::output_power_W() const noexcept {
  return (resistance_ohm_ * state_.current_A +
          torque_constant_Nm_per_A_ * state_.motor_speed_rad_per_s) *
         state_.current_A;
}

protocol::InputLines RigAxis::switch_lines() const noexcept {
  protocol::InputLines lines = 0;
  for (const HallSensor* hall : {&hall_min_, &hall_max_}) {
    lines |= hall->active() ? protocol::mask_of(hall->line()) : 0U;
  }
  return lines | (home_ && home_->active() ? protocol::mask_of(home_->line()) : 0U);
}

AxisTruth RigAxis::truth() const noexcept {
  const AxisState& state = state_;
  const AxisForces forces = plant_.forces();
  return {.motor_angle_rad = state.motor_angle_rad + skipped_rad_,
          .motor_speed_rad_per_s = state.motor_speed_rad_per_s,
          .carriage_m = state.carriage_m,
          .carriage_speed_m_per_s = state.carriage_speed_m_per_s,
          .current_A = state.current_A,
          .motor_torque_Nm = forces.motor_torque_Nm,
          .motor_friction_Nm = forces.motor_friction_Nm,
          .carriage_friction_N = forces.carriage_friction_N,
          .transmission_force_N = forces.transmission_force_N,
          .command_V = command_V_,
          .count = encoder_.count(),
          .edges_total = encoder_.edges_total() + disc_.surplus_edges() + wiring_.surplus_edges(),
          .absolute_count = told_count()};
}

}  // namespace towbench::emulator
