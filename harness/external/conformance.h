// The duties of the protocol, and whether a controller keeps them: each is tried on a process of
// its own, by a bench that refuses, falls silent, loses messages, babbles and dies.
//
// What is judged is the protocol's side alone; what a controller does to a machine is the
// campaign's.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "emulator/rig_parameters.h"
#include "harness/checks/check.h"

namespace towbench::harness {

// The names of the duties.
[[nodiscard]] std::vector<std::string> conformance_duties();
// Those of a controller of that machine.
[[nodiscard]] std::vector<std::string> conformance_duties(const emulator::RigParameters& rig);

// In the order of docs/requirements.md (CON-1 ...); of `only` alone unless it is empty. INVALID
// where a controller did nothing that would have shown the duty: one that never drives, or never
// came. About ten seconds of the host's time. What it prints is appended to `printed`. Throws
// std::system_error.
[[nodiscard]] std::vector<Check> check_conformance(const std::string& command,
                                                   const emulator::RigParameters& rig,
                                                   const std::filesystem::path& printed,
                                                   const std::string& only = {});

}  // namespace towbench::harness
