#include "study/procedures/procedures.h"

#include <algorithm>

namespace towbench::study::procedures {

std::vector<std::unique_ptr<Procedure>> identification_procedures() {
  std::vector<std::unique_ptr<Procedure>> all;
  all.push_back(drive_calibration());
  all.push_back(time_constant());
  all.push_back(saturation_speed());
  all.push_back(smallest_command());
  all.push_back(break_away_map());
  all.push_back(torque_place_map());
  all.push_back(pulse_responses());
  all.push_back(relay_tuning());  // its guard takes off the swing that the pulses have found
  all.push_back(model_tuning());  // beside the relay's gains, by the model of the pulses
  all.push_back(
      safe_range());  // takes the transmission's stretch off by what the pulses have found
  all.push_back(torque_speed_map());
  all.push_back(validation());
  return all;
}

Track track_of(const bbmc::AxisConfiguration& belief) {
  return {belief.position_m(belief.ends.soft_min_count),
          belief.position_m(belief.ends.soft_max_count)};
}

core::PerPlanarAxis<double> middle_of_tracks(const Machine& machine) {
  core::PerPlanarAxis<double> middle;
  for (const auto axis : core::kPlanarAxes) {
    const auto track = track_of(machine.configuration().axes[axis]);
    middle[axis] = 0.5 * (track.min_m + track.max_m);
  }
  return middle;
}

double value_or(const ProcedureContext& context, std::string_view quantity, double belief) {
  if (const auto* known = context.find(quantity)) {
    return known->value;
  }
  double value = belief;
  for (const auto& each : context.known) {
    if (each.quantity == quantity && each.axis == core::name_of(context.axis)) {
      value = each.value;
    }
  }
  return value;
}

Figure speed_figure(const identify::Recording& data, core::Axis axis, std::string title) {
  constexpr std::size_t kSpan = 10;
  constexpr std::size_t kPoints = 2000;
  Curve curve{.name = "speed"};
  const std::size_t every = std::max<std::size_t>(1, data.rows() / kPoints);
  for (std::size_t k = kSpan; k < data.rows(); k += every) {
    curve.x.push_back(data.time_s[k]);
    curve.y.push_back((data.position_m(axis, k) - data.position_m(axis, k - kSpan)) /
                      (data.time_s[k] - data.time_s[k - kSpan]));
  }
  return {.title = std::move(title),
          .x_label = "time, s",
          .y_label = "speed, m/s",
          .curves = {std::move(curve)},
          .caption = {}};
}

}  // namespace towbench::study::procedures
