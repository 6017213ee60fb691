// Plays one experiment on a bench: console script, exchanges, records, until the script is done,
// the time limit is reached, the plant is gone or somebody asks to stop. Where the machine may
// still move then, the run goes on until it can be expected to stand; the judge asks the truth.
#pragma once

#include <atomic>
#include <cstdint>
#include <functional>

#include "harness/experiment/experiment.h"
#include "harness/lockstep/lockstep_bench.h"
#include "harness/lockstep/operator.h"
#include "harness/lockstep/run_outcome.h"

namespace towbench::harness {

// What ends a run whose script is over: the end itself, when no motion runs; or that nothing has
// been driven for kCoasting_ns. A run with faults ends so: its controller may believe in a
// standstill that is none.
enum class RunEnd : std::uint8_t { kIdle, kUndriven };

// Longer than any axis coasts from the speed of an experiment, on a machine with little friction.
inline constexpr core::Nanoseconds kCoasting_ns = 4 * core::kNanosecondsPerSecond;
// Whatever is still driven so long after the script is not waited for.
inline constexpr core::Nanoseconds kLongestSettling_ns = 6 * core::kNanosecondsPerSecond;

struct LoopWatchers {
  // Set from outside (a signal): the run ends orderly and is incomplete. May be null.
  const std::atomic<bool>* stop = nullptr;
  // Called every few thousand exchanges with the virtual time. May be empty.
  std::function<void(core::Nanoseconds)> progress{};
  // Told where the bench waits for a controller that somebody else starts. May be empty.
  std::function<void(const std::string& address)> waiting{};
  // Told the path of a person's terminal before the run begins. May be empty.
  std::function<void(const std::string& path)> terminal{};
};

// Without `run_operator` the experiment's own is repeated, if it has one. Whoever acts by hand
// makes the run end as RunEnd::kUndriven.
[[nodiscard]] RunOutcome play(const Experiment& experiment, LockstepBench& bench,
                              BenchRecorder& recorder, const LoopWatchers& watchers,
                              RunEnd end = RunEnd::kIdle, Operator* run_operator = nullptr);

}  // namespace towbench::harness
