// The whole sequence, unattended: every procedure on every axis, each with what those before it
// found. What is done stands in the folder, so that an interrupted sequence continues where it
// stopped.
#pragma once

#include <atomic>
#include <filesystem>
#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "study/procedures/procedure.h"

namespace towbench::study::procedures {

struct SequenceOptions {
  std::vector<std::string> only;  // ids; empty: all
  std::vector<core::Axis> axes{core::Axis::kY, core::Axis::kX};
  std::filesystem::path settings;  // folder of <id>.toml; a file that is absent means defaults
  std::filesystem::path out;       // done/<axis>-<id>.json; empty: nothing is kept
  std::string fingerprint;         // of machine, controller, seed; what another left is not used,
                                   // nor what another program, settings or knowledge found
  bool resume = false;
  std::function<void(const std::string& what, double share)> progress;
  const std::atomic<bool>* stop = nullptr;  // set from outside: nothing more is begun
};

struct SequenceStep {
  std::string id;
  std::string title;
  core::Axis axis = core::Axis::kY;
  ProcedureOutcome outcome{};
  bool from_before = false;  // read, not run
  double wall_s = 0;
};

struct SequenceResult {
  std::vector<SequenceStep> steps;
  identify::Estimates estimates;  // of all that was done, in order
};

// Throws FixtureError for settings that cannot be used and std::runtime_error for a folder that
// cannot be written.
[[nodiscard]] SequenceResult run_sequence(const Machine& machine,
                                          const std::vector<std::unique_ptr<Procedure>>& procedures,
                                          const SequenceOptions& options);

}  // namespace towbench::study::procedures
