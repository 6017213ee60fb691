#include "emulator/rig.h"

#include <algorithm>

namespace towbench::emulator {

using core::Axis;
using protocol::InputLine;

namespace {

constexpr core::PerAxis<InputLine> kHallMinLine{{InputLine::kHallYMin, InputLine::kHallXMin}};
constexpr core::PerAxis<InputLine> kHallMaxLine{{InputLine::kHallYMax, InputLine::kHallXMax}};
constexpr core::PerAxis<InputLine> kReadyLine{
    {InputLine::kAmplifierReadyY, InputLine::kAmplifierReadyX}};

[[nodiscard]] Axis other(Axis axis) noexcept {
  return axis == Axis::kY ? Axis::kX : Axis::kY;
}

// Oldest first; changes of the same nanosecond keep their order. A handful at most.
void sort_by_time(LineChanges& changes) noexcept {
  for (std::size_t i = 1; i < changes.size(); ++i) {
    const LineChange moving = changes[i];
    std::size_t place = i;
    for (; place > 0 && changes[place - 1].time_ns > moving.time_ns; --place) {
      changes[place] = changes[place - 1];
    }
    changes[place] = moving;
  }
}

}  // namespace

RigAxis::RigAxis(Axis axis, const RigAxisParameters& p, const Seeds& seeds,
                 const ForeignOutput* at_start)
    : command(p.command, seeds.ripple),
      plant_(p.plant, p.start_m, at_start),
      state_(plant_.state()),
      encoder_(p.encoder, p.encoder.side == EncoderSide::kLoad
                              ? state_.carriage_m * p.plant.gear_ratio / p.plant.sprocket_radius_m
                              : state_.motor_angle_rad),
      disc_(p.encoder),
      wiring_(encoder_.levels()),
      hall_min_(p.hall_min, TravelEnd::kMin, kHallMinLine[axis], p.start_m),
      hall_max_(p.hall_max, TravelEnd::kMax, kHallMaxLine[axis], p.start_m),
      resistance_ohm_(p.plant.winding.resistance_ohm),
      torque_constant_Nm_per_A_(p.plant.torque_constant_Nm_per_A),
      motor_rad_per_m_(p.plant.gear_ratio / p.plant.sprocket_radius_m),
      sees_load_(p.encoder.side == EncoderSide::kLoad) {
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
  } else if (kind == ScheduledEventKind::kSkipChain) {
    skipped_rad_ += plant_.skip_chain(value);
    state_ = plant_.state();
  } else {
    faults_.set(kind, value, state_, command_V_);
  }
}

double RigAxis::output_power_W() const noexcept {
  return (resistance_ohm_ * state_.current_A +
          torque_constant_Nm_per_A_ * state_.motor_speed_rad_per_s) *
         state_.current_A;
}

std::uint16_t RigAxis::hall_lines() const noexcept {
  unsigned lines = 0;
  for (const HallSensor* hall : {&hall_min_, &hall_max_}) {
    lines |= hall->active() ? protocol::mask_of(hall->line()) : 0U;
  }
  return static_cast<std::uint16_t>(lines);
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
          .chain_force_N = forces.chain_force_N,
          .command_V = command_V_,
          .count = encoder_.count(),
          .edges_total = encoder_.edges_total() + disc_.surplus_edges() + wiring_.surplus_edges()};
}

Rig::Rig(const RigParameters& parameters, std::uint64_t seed)
    : parameters_(parameters), supply_(parameters.supply) {
  if (parameters.foreign_plant) {
    make_foreign();
  }
  // One stream of seeds in a fixed order, so that fitting one sensor leaves the others' noise
  // alone.
  core::Random seeds(seed);
  const core::PerAxis<std::uint64_t> axis_seed{{seeds.bits(), seeds.bits()}};
  const std::uint64_t force_seed = seeds.bits();
  const core::PerAxis<std::uint64_t> ripple_seed{{seeds.bits(), seeds.bits()}};
  if (parameters.water.present()) {
    water_.emplace(parameters.water);
    for (RigAxisParameters& axis : parameters_.axes) {
      axis.plant.water_mass_kg = added_mass_kg(parameters.water);
    }
  }
  if (parameters.force_sensor.fitted) {
    // The water that moves with the load pulls at the sensor like the load itself.
    ForceSensorParameters sensor = parameters.force_sensor;
    sensor.load_mass_kg += added_mass_kg(parameters.water);
    force_sensor_.emplace(sensor, force_seed);
  }
  if (parameters.camera.fitted) {
    camera_.emplace(parameters.camera, seeds.bits());
  }
  unsigned lines = 0;
  for (const Axis which : core::kAxes) {
    if (parameters_.axes[which].exists) {
      axes_[which].emplace(
          which, parameters_.axes[which],
          RigAxis::Seeds{.current_monitor = axis_seed[which], .ripple = ripple_seed[which]},
          foreign_ ? &foreign_outputs_[which] : nullptr);
      lines |= axes_[which]->hall_lines();
      lines |= supply_.ready() ? protocol::mask_of(kReadyLine[which]) : 0U;
    }
  }
  machine_lines_ = static_cast<std::uint16_t>(lines);
  arriving_lines_ = machine_lines_;
}

std::uint8_t Rig::axes_mask() const noexcept {
  unsigned mask = 0;
  for (const Axis which : core::kAxes) {
    mask |= axes_[which] ? 1U << core::index_of(which) : 0U;
  }
  return static_cast<std::uint8_t>(mask);
}

bool Rig::set_kill_switch(bool pressed, core::Nanoseconds time_ns) noexcept {
  if (!parameters_.kill_switch.fitted || pressed == kill_pressed_) {
    return true;
  }
  if (kill_changes_.size() == kMaxKillChangesPerStep) {
    return false;
  }
  kill_pressed_ = pressed;
  return kill_changes_.push_back({time_ns, InputLine::kKillSwitch, pressed});
}

// The step holds its input, so the tick that the change falls into gets the mean: same impulse.
void Rig::push_carriage(Axis which, double force_N, core::Nanoseconds time_ns) noexcept {
  const double missed_share =
      static_cast<double>(time_ns - now_ns_) / static_cast<double>(core::kPlantTick_ns);
  push_correction_N_[which] -= (force_N - push_N_[which]) * std::clamp(missed_share, 0.0, 1.0);
  push_N_[which] = force_N;
}

void Rig::remove_drive() noexcept {
  for (auto& axis : axes_) {
    if (axis) {
      axis->command.remove();
      axis->enable_line = false;
    }
  }
}

double Rig::cross_axis_force_N(Axis which) const noexcept {
  const double ratio = parameters_.axes[which].cross_axis_force_ratio;
  const RigAxis* neighbour = axis(other(which));
  return ratio == 0.0 || neighbour == nullptr ? 0.0
                                              : ratio * neighbour->plant().forces().chain_force_N;
}

void Rig::step() noexcept {
  changes_ = kill_changes_;
  const bool hardware_cut = parameters_.kill_switch.cuts_amplifiers &&
                            (machine_lines_ & protocol::mask_of(InputLine::kKillSwitch)) != 0;
  const bool may_drive = supply_.ready() && !hardware_cut;
  const core::PerAxis<double> cross_N{{cross_axis_force_N(Axis::kY), cross_axis_force_N(Axis::kX)}};
  if (water_) {
    feel_water();
  }
  for (const Axis which : core::kAxes) {
    if (axes_[which]) {
      axes_[which]->take_command({.supply_V = supply_.voltage_V(),
                                  .amplifier_may_drive = may_drive,
                                  .external_N = push_N_[which] + push_correction_N_[which] +
                                                cross_N[which] + water_N_[which]});
      push_correction_N_[which] = 0.0;
    }
  }
  if (foreign_) {
    step_foreign();
  }
  double power_W = 0.0;
  for (const Axis which : core::kAxes) {
    if (!axes_[which]) {
      continue;
    }
    axes_[which]->move(now_ns_, foreign_outputs_[which], changes_);
    power_W += std::max(0.0, axes_[which]->output_power_W());
  }
  const bool was_ready = supply_.ready();
  supply_.step(power_W);
  now_ns_ += core::kPlantTick_ns;
  kill_changes_.clear();
  if (force_sensor_) {
    measure_force();
  }
  if (camera_) {
    expose_frame();
  }
  if (supply_.ready() != was_ready) {
    update_ready_lines();
  }
  sort_by_time(changes_);
  input_wiring_.step(machine_lines_, arriving_lines_, changes_);
}

void Rig::make_foreign() {
  core::PerAxis<std::optional<double>> starts_m;
  for (const Axis which : core::kAxes) {
    if (parameters_.axes[which].exists) {
      starts_m[which] = parameters_.axes[which].start_m;
    }
  }
  foreign_ = parameters_.foreign_plant->make(starts_m);
  (void)foreign_->step(0.0, {}, foreign_outputs_);
}

void Rig::step_foreign() noexcept {
  core::PerAxis<ForeignInput> inputs;
  for (const Axis which : core::kAxes) {
    if (axes_[which]) {
      inputs[which] = axes_[which]->foreign_input();
    }
  }
  if (!foreign_->step(core::seconds(now_ns_ + core::kPlantTick_ns), inputs, foreign_outputs_)) {
    for (ForeignOutput& output : foreign_outputs_) {
      output = {.position_m = output.position_m, .motor_angle_rad = output.motor_angle_rad};
    }
  }
}

void Rig::feel_water() noexcept {
  core::PerAxis<double> velocity{};
  for (const Axis which : core::kAxes) {
    velocity[which] = axes_[which] ? axes_[which]->coming_carriage_speed_m_per_s() : 0.0;
  }
  water_N_ = water_->force_N(now_ns_, velocity);
}

// A push acts on the load, below the sensor (FR-3), and so does the water.
void Rig::measure_force() noexcept {
  core::PerAxis<double> acceleration{};
  core::PerAxis<double> load_N = push_N_;
  for (const Axis which : core::kAxes) {
    acceleration[which] = axes_[which] ? axes_[which]->carriage_acceleration_m_per_s2() : 0.0;
    load_N[which] += water_N_[which];
  }
  protocol::ForceSample sample;
  const bool taken = force_sensor_->step(now_ns_, load_N, acceleration, sample);
  force_sample_ = taken ? std::optional(sample) : std::nullopt;
}

void Rig::expose_frame() noexcept {
  core::PerAxis<double> carriage_m{};
  for (const Axis which : core::kAxes) {
    carriage_m[which] = axes_[which] ? axes_[which]->carriage_m() : 0.0;
  }
  camera_frame_ = camera_->see(now_ns_, carriage_m);
}

// The amplifiers notice the supply at the end of the tick: its last nanosecond.
void Rig::update_ready_lines() noexcept {
  for (const Axis which : core::kAxes) {
    if (axes_[which]) {
      (void)changes_.push_back({now_ns_ - 1, kReadyLine[which], supply_.ready()});
    }
  }
}

TruthRow Rig::truth() const noexcept {
  TruthRow row;
  row.time_ns = now_ns_;
  for (const Axis which : core::kAxes) {
    if (axes_[which]) {
      row.axes[which] = axes_[which]->truth();
    }
  }
  row.input_lines = arriving_lines_;
  return row;
}

}  // namespace towbench::emulator
