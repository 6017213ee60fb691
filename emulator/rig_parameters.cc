#include "emulator/rig_parameters.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace towbench::emulator {
namespace {

// docs/reference/constants.md, "travel, counts" and "hall min / max at" (7.2.1; firmware presets).
constexpr double kYHallMin_counts = 1'000.0;
constexpr double kYHallMax_counts = 1'740'000.0;
constexpr double kXTravel_counts = 505'000.0;
constexpr double kXHallMin_counts = 1'000.0;
constexpr double kXHallMax_counts = 500'000.0;

// X differs from the default axis, which is Y. Mostly assumed: the thesis identified Y only.
AxisParameters nominal_x_plant() noexcept {
  AxisParameters x;
  x.inertia_kg_m2 = 2.0e-6;
  x.rotor_inertia_kg_m2 = 1.3e-6;
  x.viscous_friction_Nm_s_per_rad = 4e-6;
  x.coulomb_friction_Nm = 1.6e-3;
  x.output_radius_m = 0.030;
  x.torque_constant_Nm_per_A = 23.5e-3;
  x.winding.resistance_ohm = 2.3;
  x.winding.inductance_H = 0.24e-3;
  x.friction.breakaway_Nm = 2.4e-3;
  x.friction.position = {};
  x.elasticity.resonance_Hz = 22.0;
  return x;
}

void place_halls(RigAxisParameters& axis, double min_counts, double max_counts) noexcept {
  axis.hall_min.position_m = min_counts * metres_per_count(axis);
  axis.hall_max.position_m = max_counts * metres_per_count(axis);
}

[[nodiscard]] bool whole_ticks(double period_s) noexcept {
  return core::nanoseconds(period_s) % core::kPlantTick_ns == 0;
}

// (3.39) the other way round: what of the effective inertia moves with the carriage.
[[nodiscard]] double carriage_mass_kg(const AxisParameters& p) noexcept {
  const double motor_rad_per_m = p.gear_ratio / p.output_radius_m;
  return (p.inertia_kg_m2 - p.rotor_inertia_kg_m2) * motor_rad_per_m * motor_rad_per_m;
}

// Drag is held over a tick: that is stable and second order while it takes little of the speed in
// one. At 2 m/s, four times what the drive can do.
[[nodiscard]] bool too_thick(const WaterParameters& water, double moved_kg) noexcept {
  constexpr double kFastest_m_per_s = 2.0;
  constexpr double kLargestShare = 0.2;
  double slope_N_s_per_m = 0.0;
  for (const WaterBodyParameters* body : {&water.shaft, &water.object}) {
    const double along =
        2.0 * body->quadratic_drag_N_s2_per_m2 * kFastest_m_per_s + body->linear_drag_N_s_per_m;
    slope_N_s_per_m += body->in_water ? along * std::fmax(1.0, body->across_drag_ratio) : 0.0;
  }
  return slope_N_s_per_m * core::kPlantTick_s > kLargestShare * moved_kg;
}

// An absolute count has 32 bits: so many, with room for ends that give way and a disc that slips.
constexpr double kFarthest_counts = 2e9;

[[nodiscard]] bool outgrows_absolute_count(const RigAxisParameters& axis) noexcept {
  const auto is_far = [&](double place_m) {
    return std::fabs(place_m) > kFarthest_counts * metres_per_count(axis);
  };
  const HardEndParameters& ends = axis.plant.hard_ends;
  return is_far(axis.start_m) || (ends.fitted && (is_far(ends.min_m) || is_far(ends.max_m)));
}

const char* inconsistency(const RigAxisParameters& axis) noexcept {
  if (!axis.exists) {
    return nullptr;
  }
  if (const char* found = inconsistency(axis.plant)) {
    return found;
  }
  const EncoderParameters& encoder = axis.encoder;
  if (encoder.counts_per_turn % 4 != 0) {
    return "encoder_counts_per_rev must be a multiple of 4";
  }
  if (encoder.index_count >= encoder.counts_per_turn) {
    return "encoder.index_count must be below encoder_counts_per_rev";
  }
  if (std::fabs(encoder.phase_deg - 90.0) + std::fabs(encoder.pulse_width_deg - 180.0) > 80.0) {
    return "encoder.phase_deg and encoder.pulse_width_deg together swap edges of A and B";
  }
  // Eccentricity stretches the turn by 2 pi e / N; edges 10 electrical degrees apart must stay so.
  if (2.0 * std::numbers::pi * encoder.eccentricity_counts >
      0.1 * static_cast<double>(encoder.counts_per_turn)) {
    return "encoder.eccentricity_counts is too large for encoder_counts_per_rev";
  }
  const HardEndParameters& ends = axis.plant.hard_ends;
  if (ends.fitted && (axis.start_m < ends.min_m || axis.start_m > ends.max_m)) {
    return "start_m lies outside hard_ends";
  }
  if (encoder.absolute && outgrows_absolute_count(axis)) {
    return "encoder.absolute: start_m and hard_ends must lie within 2e9 counts of 0: it tells 32 "
           "bits";
  }
  if (axis.hall_min.fitted && axis.hall_max.fitted &&
      axis.hall_min.position_m >= axis.hall_max.position_m) {
    return "hall_min.position_m must be below hall_max.position_m";
  }
  if (axis.home.fitted && ends.fitted &&
      (axis.home.position_m < ends.min_m || axis.home.position_m > ends.max_m)) {
    return "home.position_m must lie within hard_ends";
  }
  if (axis.current_monitor.fitted && !whole_ticks(axis.current_monitor.sample_period_s)) {
    return "current_monitor.sample_period_s must be a whole number of 100 us ticks";
  }
  return nullptr;
}

[[nodiscard]] bool rides_on_itself(const RigAxes& axes, core::Axis which) noexcept {
  auto below = axis_of(axes[which].carried_by);
  for (std::size_t steps = 0; below && *below != which && steps < core::kMostAxes; ++steps) {
    below = axis_of(axes[*below].carried_by);
  }
  return below == which;
}

// What a sliding axis carries of sliding axes, each with what it carries itself.
[[nodiscard]] double carried_kg(const RigAxes& axes, core::Axis which) noexcept {
  double carried = 0.0;
  for (const core::Axis other : core::kAllAxes) {
    if (axes[other].exists && !axes[other].load_turns && axis_of(axes[other].carried_by) == which) {
      carried += carriage_mass_kg(axes[other].plant);
    }
  }
  return carried;
}

[[nodiscard]] const char* inconsistent_nesting(const RigAxes& axes) noexcept {
  for (const core::Axis which : core::kAllAxes) {
    const RigAxisParameters& axis = axes[which];
    if (!axis.exists) {
      continue;
    }
    const auto carrier = axis_of(axis.carried_by);
    if (carrier && !axes[*carrier].exists) {
      return "carried_by names an axis that the machine does not have";
    }
    if (rides_on_itself(axes, which)) {
      return "carried_by: an axis rides on itself";
    }
    if (!axis.load_turns && carried_kg(axes, which) > carriage_mass_kg(axis.plant)) {
      return "carried_by: an axis moves less than what it carries";
    }
    const bool is_nested =
        carrier || std::any_of(axes.begin(), axes.end(), [&](const RigAxisParameters& other) {
          return other.exists && axis_of(other.carried_by) == which;
        });
    if (axis.cross_axis_force_ratio != 0.0 && !is_nested) {
      return "cross_axis_force_ratio is of an axis that is carried or carries another";
    }
  }
  return nullptr;
}

}  // namespace

RigParameters::RigParameters() noexcept {
  RigAxisParameters& y = axes[core::Axis::kY];
  place_halls(y, kYHallMin_counts, kYHallMax_counts);
  RigAxisParameters& x = axes[core::Axis::kX];
  x.plant = nominal_x_plant();
  x.plant.hard_ends.max_m = kXTravel_counts * metres_per_count(x);
  place_halls(x, kXHallMin_counts, kXHallMax_counts);
  x.carried_by = Carrier::kY;
  for (const core::Axis further : core::kFurtherAxes) {
    axes[further].exists = false;
  }
}

bool has_further_axes(const RigParameters& rig) noexcept {
  return std::any_of(core::kFurtherAxes.begin(), core::kFurtherAxes.end(),
                     [&](core::Axis which) { return rig.axes[which].exists; });
}

bool tells_counts(const RigParameters& rig) noexcept {
  return std::any_of(rig.axes.begin(), rig.axes.end(), [](const RigAxisParameters& axis) {
    return axis.exists && axis.encoder.absolute;
  });
}

double metres_per_count(const RigAxisParameters& axis) noexcept {
  return 2.0 * std::numbers::pi * axis.plant.output_radius_m /
         (axis.plant.gear_ratio * static_cast<double>(axis.encoder.counts_per_turn));
}

const char* inconsistency(const RigParameters& rig) noexcept {
  bool any_axis = false;
  for (const RigAxisParameters& axis : rig.axes) {
    any_axis = any_axis || axis.exists;
    if (const char* found = inconsistency(axis)) {
      return found;
    }
  }
  if (const char* found = inconsistent_nesting(rig.axes)) {
    return found;
  }
  for (const core::Axis which : core::kPlanarAxes) {
    const RigAxisParameters& axis = rig.axes[which];
    if (axis.exists && rig.force_sensor.fitted &&
        rig.force_sensor.load_mass_kg > carriage_mass_kg(axis.plant)) {
      return "force_sensor.load_mass_kg is more than an axis moves";
    }
    if (axis.exists && too_thick(rig.water, carriage_mass_kg(axis.plant))) {
      return "water: drag stops what an axis moves within a few 100 us ticks";
    }
  }
  if (const char* found = inconsistency(rig.water)) {
    return found;
  }
  if (!any_axis) {
    return "no axis exists";
  }
  if (rig.supply.voltage_V < rig.supply.cut_out_V) {
    return "supply.voltage_V is below supply.cut_out_V";
  }
  if (rig.force_sensor.fitted && !whole_ticks(rig.force_sensor.sample_period_s)) {
    return "force_sensor.sample_period_s must be a whole number of 100 us ticks";
  }
  if (rig.camera.fitted && !whole_ticks(rig.camera.frame_period_s)) {
    return "camera.frame_period_s must be a whole number of 100 us ticks";
  }
  return nullptr;
}

}  // namespace towbench::emulator
