// An axis of a rig as a Functional Mock-up Unit (FMI 3.0, Co-Simulation).
#pragma once

#include <filesystem>
#include <string>

#include "emulator/rig_parameters.h"

namespace towbench::harness {

// modelDescription.xml of the axis. `name`: of the model.
[[nodiscard]] std::string axis_description(const std::string& name,
                                           const emulator::RigParameters& rig, core::Axis axis);

// Writes the unit. `binary`: the shared library that the build makes of emulator/fmi. Water, the
// other axis and faults are not part of it. Throws std::runtime_error.
void export_axis(const std::filesystem::path& file, const std::string& name,
                 const emulator::RigParameters& rig, core::Axis axis,
                 const std::filesystem::path& binary);

}  // namespace towbench::harness
