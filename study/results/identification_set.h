// The whole identification on many machines and seeds, each run judged and kept, all pooled:
// ID-0 of docs/requirements.md.
#pragma once

#include <atomic>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <string>
#include <vector>

#include "harness/fixtures/controller_fixture.h"
#include "harness/fixtures/rig_fixture.h"
#include "study/procedures/machine.h"
#include "study/recovery/recovery.h"
#include "study/results/foreign_machines.h"

namespace towbench::study {

// A machine like `rig` in which what no data sheet says is off by up to `spread`, the same for the
// same number; 0 is `rig` itself.
[[nodiscard]] harness::RigFixture drawn_machine(harness::RigFixture rig, std::uint64_t number,
                                                double spread);

// A machine of a set as it is, under the documents that it has; structure: null is its own.
struct DrawnRig {
  harness::RigFixture documents;
  harness::RigFixture truth;
  [[nodiscard]] procedures::Machine machine(const harness::ControllerFixture& controller,
                                            std::uint64_t seed,
                                            harness::LoopWatchers watchers) const;
};
[[nodiscard]] DrawnRig drawn_rig(const harness::RigFixture& rig, std::uint64_t number,
                                 double spread, const ForeignStructure* structure);

struct IdentificationSet {
  harness::RigFixture rig;
  harness::ControllerFixture controller;
  std::filesystem::path settings;
  std::filesystem::path out;  // machine-<i>/seed-<j>: what is done there stays
  // Empty: `machines` of the rig's own structure. Else one machine of each structure, drawn anew
  // for each seed, the first nominal.
  std::span<const ForeignStructure> structures{};
  std::uint64_t machines = 10;
  std::uint64_t seeds = 40;
  double spread = 0.4;
  std::size_t workers = 1;  // processes at once
  std::vector<core::Axis> axes;
  const std::atomic<bool>* stop = nullptr;
  std::function<void(std::size_t done, std::size_t all)> progress;
};

struct SetRun {
  std::uint64_t machine = 0;
  std::uint64_t seed = 0;
  bool done = false;                    // false: interrupted
  std::vector<std::string> not_done{};  // experiments refused or failed, with the reason
  std::vector<std::string> withheld{};  // "inertia_kg_m2 y: reason"
  std::vector<Recovery> recoveries{};
};

// Runs what is not there yet. Throws std::runtime_error when nothing can be written or no process
// be started.
[[nodiscard]] std::vector<SetRun> run_set(const IdentificationSet& set);

// Markdown: coverage of the intervals, widths and misses, by quantity and pooled.
[[nodiscard]] std::string set_page(const IdentificationSet& set, const std::vector<SetRun>& runs);
// The same by structure.
[[nodiscard]] std::string foreign_page(const IdentificationSet& set,
                                       const std::vector<SetRun>& runs);

}  // namespace towbench::study
