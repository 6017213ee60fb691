// Every tow experiment on several machines with many seeds, each run judged and kept: how often the
// intervals hold what the water truly is.
#pragma once

#include <atomic>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <string>
#include <utility>
#include <vector>

#include "harness/fixtures/controller_fixture.h"
#include "harness/fixtures/rig_fixture.h"
#include "study/recovery/recovery.h"

namespace towbench::study {

// A machine like `rig` with other friction, inertia, motor and transmission, the same for the same
// number; 0 is `rig` itself. The motor constant is only ever lower: a higher one could not reach
// the thesis's 0.55 m/s at 10.8 V.
[[nodiscard]] harness::RigFixture drawn_for_towing(harness::RigFixture rig, std::uint64_t number);

struct TowSet {
  harness::RigFixture rig;
  harness::ControllerFixture controller;
  std::filesystem::path rigs;      // folder of the loads' rig files
  std::filesystem::path settings;  // folder of the experiments' own files
  std::filesystem::path out;       // machine-<i>/seed-<j>.json: what is done there stays
  std::vector<std::string> only;   // experiments; empty: all
  std::uint64_t machines = 1;
  std::uint64_t seeds = 40;
  std::size_t workers = 1;  // processes at once
  const std::atomic<bool>* stop = nullptr;
  std::function<void(std::size_t done, std::size_t all)> progress{};
};

struct TowSetRun {
  std::uint64_t machine = 0;
  std::uint64_t seed = 0;
  bool done = false;                    // false: interrupted
  std::vector<std::string> not_done{};  // experiments refused or failed, with the reason
  std::vector<Recovery> recoveries{};
};

// Runs what is not there yet. Throws std::runtime_error when nothing can be written or no process
// be started.
[[nodiscard]] std::vector<TowSetRun> run_tow_set(const TowSet& set);

// Of one quantity, over all machines, seeds and places of its map.
struct TowCoverage {
  std::string quantity;
  std::size_t intervals = 0;
  std::size_t covered = 0;
  double mean_error_pct = 0;
  double worst_error_pct = 0;  // largest size
  double mean_width_pct = 0;   // of the whole intervals
  std::string withheld{};      // why it has no interval; then nothing is covered

  [[nodiscard]] double share() const noexcept {
    return static_cast<double>(covered) / static_cast<double>(intervals);
  }
  // kHeld: 90 to 99 %. kLikely: outside, but what a true share within 90 to 99 % gives by chance in
  // one of twenty campaigns as large; of sound intervals of 95 %, 40 of 40 hold the truth every
  // eighth time.
  enum class Verdict { kHeld, kLikely, kNot };
  [[nodiscard]] Verdict verdict() const;
  // The shares that so many covered of so many are likely from (Clopper and Pearson, 95 %).
  [[nodiscard]] std::pair<double, double> range() const;
};

[[nodiscard]] std::vector<TowCoverage> coverage_of(const std::vector<TowSetRun>& runs);
// Markdown: a row a quantity.
[[nodiscard]] std::string tow_coverage_page(const TowSet& set, const std::vector<TowSetRun>& runs);

}  // namespace towbench::study
