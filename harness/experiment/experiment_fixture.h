// Reads an experiment file and every file that it names.
#pragma once

#include <filesystem>

#include "harness/experiment/experiment.h"
#include "harness/fixtures/controller_fixture.h"
#include "harness/fixtures/fixture_file.h"
#include "harness/fixtures/rig_fixture.h"

namespace towbench::harness {

// All that a run needs, resolved and checked.
struct ExperimentFixture {
  std::filesystem::path file;
  std::filesystem::path rig_file;
  std::filesystem::path controller_file;
  Experiment experiment;
  RigFixture rig;
  ControllerFixture controller;
  SourceFiles sources;     // every file read, this one first
  std::uint64_t hash = 0;  // of the experiment's own text
};

// The file alone; what it names is left unread. Throws FixtureError.
[[nodiscard]] Experiment read_experiment(const FixtureFile& file);

// Throws FixtureError.
[[nodiscard]] ExperimentFixture load_experiment(const std::filesystem::path& path);

// The wiring file that the experiment's file names; empty: none. Throws FixtureError.
[[nodiscard]] std::filesystem::path wiring_file(const std::filesystem::path& experiment);

}  // namespace towbench::harness
