#include "harness/panel/shown_configuration.h"

#include <cmath>

namespace towbench::harness {

ShownMachine::ShownMachine(const bbmc::Configuration& configuration)
    : shown(planar_axes()), control_rate_Hz(configuration.control_rate_Hz) {
  for (const auto which : core::kAllAxes) {
    axes[which] = configuration.axes[core::is_planar(which) ? which : core::kFirstAxis];
  }
}

ShownMachine shown_configuration(const ExperimentFixture& fixture) {
  ShownMachine shown(fixture.controller.configuration);
  if (fixture.experiment.reference.empty()) {
    return shown;
  }
  shown.shown = recorded_axes(fixture.rig.parameters.axes);
  for (const auto which : shown.shown) {
    const auto& rig = fixture.rig.parameters.axes[which];
    auto& axis = shown.axes[which];
    axis.gear_ratio = rig.plant.gear_ratio;
    axis.sprocket_radius_m = rig.plant.output_radius_m;
    axis.encoder_counts_per_rev = rig.encoder.counts_per_turn;
    axis.ends.soft_min_count = std::llround(rig.plant.hard_ends.min_m / axis.m_per_count());
    axis.ends.soft_max_count = std::llround(rig.plant.hard_ends.max_m / axis.m_per_count());
  }
  return shown;
}

}  // namespace towbench::harness
