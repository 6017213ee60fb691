#include "study/identify/two_mass_simulation.h"

#include <cmath>

#include "emulator/plant/axis_plant.h"

namespace towbench::study::identify {

std::optional<std::vector<double>> simulate_counts(const emulator::AxisParameters& parameters,
                                                   const DrivePath& path, const Recording& data,
                                                   core::Axis axis) {
  if (data.rows() < 2 || emulator::inconsistency(parameters) != nullptr) {
    return std::nullopt;
  }
  const auto& columns = data.axes[axis];
  emulator::AxisPlant plant(parameters, data.position_m(axis, 0));
  emulator::MotionSegments segments;
  const double first_rad = plant.state().motor_angle_rad;
  const double first_count = static_cast<double>(columns.count[0]) + 0.5;
  const double per_count = data.rad_per_count[axis];
  const double late_share = path.delay_s / core::kPlantTick_s;
  double last_V = 0;
  std::vector<double> counts(data.rows());
  for (std::size_t k = 0; k < data.rows(); ++k) {
    counts[k] = first_count + (plant.state().motor_angle_rad - first_rad) / per_count;
    if (k + 1 == data.rows()) {
      break;
    }
    const double target_V = columns.duty_pct[k] / 100 * path.pwm_amplitude_V;
    const auto ticks = std::lround((data.time_s[k + 1] - data.time_s[k]) / core::kPlantTick_s);
    for (long tick = 0; tick < ticks; ++tick) {
      // The tick in which a change arrives sees the mean of old and new.
      const double mean_V = tick == 0 ? target_V + (last_V - target_V) * late_share : target_V;
      plant.step({.command_V = mean_V, .supply_V = path.supply_V, .amplifier_enabled = true},
                 segments);
    }
    last_V = target_V;
  }
  return counts;
}

}  // namespace towbench::study::identify
