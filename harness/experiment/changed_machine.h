// A machine that differs from a rig's in what is known of it to some per cent only, as the text of
// a rig file.
#pragma once

#include <array>
#include <filesystem>
#include <string>
#include <string_view>

#include "core/axis.h"
#include "harness/experiment/experiment_fixture.h"

namespace towbench::harness {

// Of each axis. Inertia: what the rotor carries, for the rotor itself is well known. Dry friction:
// sliding and break-away together. Where the end-stops sit is set at commissioning.
inline constexpr std::array<std::string_view, 9> kUncertainQuantities = {
    "inertia",         "viscous friction",       "dry friction",         "torque constant",
    "amplifier gain",  "transmission resonance", "transmission damping", "delay of min end",
    "delay of max end"};

// One factor each, 1: as the rig has it.
using MachineFactors = core::PerAxis<std::array<double, kUncertainQuantities.size()>>;

// The text of `rig_file`, which made `rig`, with the values of its axes changed and the paths of
// its plants as seen from `folder`. `source`: what each changed value names as its source.
// Throws FixtureError when the file has no line of its own that sets its plants.
[[nodiscard]] std::string changed_machine(const std::filesystem::path& rig_file,
                                          const emulator::RigParameters& rig,
                                          const MachineFactors& factors, std::string_view source,
                                          const std::filesystem::path& folder);

// `text` with the line that sets `key` replaced; an error when there is none: what is written must
// be what was meant. `file` is named in it.
[[nodiscard]] std::string with_line(const std::string& text, const std::string& key,
                                    const std::string& value, const std::filesystem::path& file);

[[nodiscard]] std::string path_from(const std::filesystem::path& file,
                                    const std::filesystem::path& folder);

}  // namespace towbench::harness
