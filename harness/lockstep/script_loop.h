// Plays one experiment on a bench: console script, exchanges, records, until the script is done,
// the time limit is reached, the plant is gone or somebody asks to stop.
#pragma once

#include <atomic>
#include <functional>

#include "harness/experiment/experiment.h"
#include "harness/lockstep/hand.h"
#include "harness/lockstep/lockstep_bench.h"
#include "harness/lockstep/run_outcome.h"

namespace towbench::harness {

struct LoopWatchers {
  // Set from outside (a signal): the run ends orderly and is incomplete. May be null.
  const std::atomic<bool>* stop = nullptr;
  // Called every few thousand exchanges with the virtual time. May be empty.
  std::function<void(core::Nanoseconds)> progress{};
  // Told the path of a person's terminal before the run begins. May be empty.
  std::function<void(const std::string& path)> terminal{};
};

// Without `hand` the experiment's own is repeated, if it has one.
[[nodiscard]] RunOutcome play(const Experiment& experiment, LockstepBench& bench,
                              BenchRecorder& recorder, const LoopWatchers& watchers,
                              Hand* hand = nullptr);

}  // namespace towbench::harness
