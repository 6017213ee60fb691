// The machine by its model: the duty of a recording through the two bodies of (3.37)-(3.38), with
// the real hold of the duty and the real limits of the amplifier.
//
// It is the emulator's own axis (emulator/plant), which is exact between events. A parameter set
// that is one millionth off moves its answer by about as much.
#pragma once

#include <optional>
#include <vector>

#include "emulator/plant/axis_parameters.h"
#include "study/identify/recording.h"

namespace towbench::study::identify {

// What is not the axis itself.
struct DrivePath {
  double pwm_amplitude_V = 10;
  double delay_s = 20e-6;  // from the row's time to the amplifier's input, below 100 us
  double supply_V = 12;
};

// Motor angle in counts (not rounded) at each row's time. Starts at rest where the first row
// stands, transmission relaxed. None when the parameters are inconsistent.
[[nodiscard]] std::optional<std::vector<double>> simulate_counts(
    const emulator::AxisParameters& parameters, const DrivePath& path, const Recording& data,
    core::Axis axis);

}  // namespace towbench::study::identify
