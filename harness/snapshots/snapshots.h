// A fault-free run, saved at chosen moments by fork(2) and gone on from, many times, each time with
// a fault of its own that begins at or after the moment.
//
// A lockstep run in one process has one thread and no state outside its memory, so that a process
// which has run up to an exchange is the whole bench at that exchange: plant, sensors, messages
// under way, controller, record, random streams. What goes on from there gives the same bytes as a
// run that was planned with the fault (tests/harness/snapshots).
#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include <sys/types.h>

#include "harness/experiment/experiment_fixture.h"
#include "harness/fault_cases/case_record.h"
#include "harness/lockstep/injection.h"

namespace towbench::harness {

// What a process that goes on does with a request; called there.
struct SnapshotWork {
  // What happens from the moment on.
  std::function<Injection(const std::string& request)> injection;
  // Told to whoever asked; at most kLongestAnswer bytes.
  std::function<std::string(const std::string& request, std::unique_ptr<CaseRecord> run)> answer;
};
inline constexpr std::size_t kLongestAnswer = 100'000;

class Snapshots {
 public:
  // Not for an experiment that was driven by hand. `moments_ns` rise; each is saved at the first
  // exchange that is not earlier, while the script runs. The calling process has one thread.
  // Comes back when the run is over. Throws std::system_error.
  Snapshots(const ExperimentFixture& plain, std::uint64_t seed,
            const std::vector<core::Nanoseconds>& moments_ns, SnapshotWork work);
  Snapshots(const Snapshots&) = delete;
  Snapshots& operator=(const Snapshots&) = delete;
  ~Snapshots();

  // Goes on in a process of its own and waits for its answer. `from_ns`: when what the request does
  // begins. The run goes on from the last moment that was saved before. None when there is no such
  // moment, or that process ended without an answer.
  [[nodiscard]] std::optional<std::string> ask(core::Nanoseconds from_ns,
                                               const std::string& request);

 private:
  class HeldRun;
  [[noreturn]] static void hold(const ExperimentFixture& plain, std::uint64_t seed,
                                const std::vector<core::Nanoseconds>& moments_ns,
                                const std::vector<int>& sockets, int ready,
                                const SnapshotWork& work);

  std::vector<core::Nanoseconds> taken_ns_;  // when each was saved
  std::vector<int> sockets_;                 // one a moment, to the process that is there
  pid_t first_ = -1;
};

// `count` of them, evenly from 0 to `end_ns`.
[[nodiscard]] std::vector<core::Nanoseconds> even_moments(core::Nanoseconds end_ns,
                                                          std::size_t count);

}  // namespace towbench::harness
