#include "emulator/rig.h"

#include <algorithm>
#include <numbers>

namespace towbench::emulator {

using core::Axis;
using protocol::InputLine;

namespace {

[[nodiscard]] bool carries(const RigAxes& axes, Axis below, Axis above) noexcept {
  return axis_of(axes[above].carried_by) == below;
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

Rig::Rig(const RigParameters& parameters, std::uint64_t seed)
    : parameters_(parameters), supply_(parameters.supply) {
  if (parameters.foreign_plant) {
    make_foreign();
  }
  // One stream of seeds in a fixed order, so that fitting one sensor leaves the others' noise
  // alone.
  core::Random seeds(seed);
  core::PerAxis<RigAxis::Seeds> axis_seeds;
  for (const Axis which : core::kPlanarAxes) {
    axis_seeds[which].current_monitor = seeds.bits();
  }
  const std::uint64_t force_seed = seeds.bits();
  for (const Axis which : core::kPlanarAxes) {
    axis_seeds[which].ripple = seeds.bits();
  }
  const std::uint64_t camera_seed = seeds.bits();
  for (const Axis which : core::kFurtherAxes) {
    axis_seeds[which] = {.current_monitor = seeds.bits(), .ripple = seeds.bits()};
  }
  if (parameters.water.present()) {
    water_.emplace(parameters.water);
    for (const Axis which : core::kPlanarAxes) {
      parameters_.axes[which].plant.water_mass_kg = added_mass_kg(parameters.water);
    }
  }
  if (parameters.force_sensor.fitted) {
    // The water that moves with the load pulls at the sensor like the load itself.
    ForceSensorParameters sensor = parameters.force_sensor;
    sensor.load_mass_kg += added_mass_kg(parameters.water);
    force_sensor_.emplace(sensor, force_seed);
  }
  if (parameters.camera.fitted) {
    camera_.emplace(parameters.camera, camera_seed);
  }
  protocol::InputLines lines = 0;
  for (const Axis which : core::kAllAxes) {
    if (parameters_.axes[which].exists) {
      axes_[which].emplace(which, parameters_.axes[which], axis_seeds[which],
                           foreign_ ? &foreign_outputs_[which] : nullptr);
      axes_mask_ = static_cast<std::uint8_t>(axes_mask_ | 1U << core::index_of(which));
      axis_count_ = core::index_of(which) + 1;
      lines |= axes_[which]->switch_lines();
      lines |= supply_.ready() ? protocol::mask_of(protocol::ready_line(which)) : 0U;
    }
  }
  machine_lines_ = lines;
  arriving_lines_ = machine_lines_;
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
      axis->brake_release_line = false;
    }
  }
}

double Rig::cross_axis_force_N(Axis which) const noexcept {
  const RigAxes& nested = parameters_.axes;
  const double ratio = nested[which].cross_axis_force_ratio;
  if (ratio == 0.0) {
    return 0.0;
  }
  double force_N = 0.0;
  for (const Axis other : axes()) {
    const RigAxis* neighbour = axis(other);
    if (neighbour != nullptr && (carries(nested, other, which) || carries(nested, which, other))) {
      force_N += neighbour->plant().forces().transmission_force_N;
    }
  }
  return ratio * force_N;
}

void Rig::step() noexcept {
  changes_ = kill_changes_;
  const bool hardware_cut = parameters_.kill_switch.cuts_amplifiers &&
                            (machine_lines_ & protocol::mask_of(InputLine::kKillSwitch)) != 0;
  const bool may_drive = supply_.ready() && !hardware_cut;
  core::PerAxis<double> cross_N{};
  for (const Axis which : axes()) {
    cross_N[which] = cross_axis_force_N(which);
  }
  if (water_) {
    feel_water();
  }
  for (const Axis which : axes()) {
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
  for (const Axis which : axes()) {
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
  for (const Axis which : core::kAllAxes) {
    if (parameters_.axes[which].exists) {
      starts_m[which] = parameters_.axes[which].start_m;
    }
  }
  foreign_ = parameters_.foreign_plant->make(starts_m);
  (void)foreign_->step(0.0, {}, foreign_outputs_);
}

void Rig::step_foreign() noexcept {
  core::PerAxis<ForeignInput> inputs;
  for (const Axis which : axes()) {
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

bool Rig::turns_load() const noexcept {
  return axes_[Axis::kC].has_value() && parameters_.axes[Axis::kC].load_turns;
}

// In the middle of the next step.
PlaneTurn Rig::load_turn() const noexcept {
  const RigAxis& c = *axes_[Axis::kC];
  const double angle_rad =
      c.carriage_m() + 0.5 * core::kPlantTick_s * c.coming_carriage_speed_m_per_s();
  return PlaneTurn(angle_rad / (2.0 * std::numbers::pi));
}

void Rig::feel_water() noexcept {
  core::PerPlanarAxis<double> velocity{};
  for (const Axis which : core::kPlanarAxes) {
    velocity[which] = axes_[which] ? axes_[which]->coming_carriage_speed_m_per_s() : 0.0;
  }
  const auto force_N = turns_load() ? water_->force_N(now_ns_, velocity, load_turn())
                                    : water_->force_N(now_ns_, velocity);
  for (const Axis which : core::kPlanarAxes) {
    water_N_[which] = force_N[which];
  }
}

// A push acts on the load, below the sensor (FR-3), and so does the water.
void Rig::measure_force() noexcept {
  core::PerPlanarAxis<double> acceleration{};
  core::PerPlanarAxis<double> load_N{};
  for (const Axis which : core::kPlanarAxes) {
    acceleration[which] = axes_[which] ? axes_[which]->carriage_acceleration_m_per_s2() : 0.0;
    load_N[which] = push_N_[which] + water_N_[which];
  }
  protocol::ForceSample sample;
  const bool taken = force_sensor_->step(now_ns_, load_N, acceleration, sample);
  force_sample_ = taken ? std::optional(sample) : std::nullopt;
}

void Rig::expose_frame() noexcept {
  core::PerPlanarAxis<double> carriage_m{};
  for (const Axis which : core::kPlanarAxes) {
    carriage_m[which] = axes_[which] ? axes_[which]->carriage_m() : 0.0;
  }
  camera_frame_ = camera_->see(now_ns_, carriage_m);
}

// The amplifiers notice the supply at the end of the tick: its last nanosecond.
void Rig::update_ready_lines() noexcept {
  for (const Axis which : core::kPlanarAxes) {
    if (axes_[which]) {
      (void)changes_.push_back({now_ns_ - 1, protocol::ready_line(which), supply_.ready()});
    }
  }
  if (axes_mask_ >= 1U << core::kPlanarAxes.size()) {
    (void)changes_.push_back({now_ns_ - 1, InputLine::kFurtherAmplifiersReady, supply_.ready()});
  }
}

TruthRow Rig::truth() const noexcept {
  TruthRow row;
  row.time_ns = now_ns_;
  for (const Axis which : axes()) {
    if (axes_[which]) {
      row.axes[which] = axes_[which]->truth();
    }
  }
  row.input_lines = arriving_lines_;
  return row;
}

}  // namespace towbench::emulator
