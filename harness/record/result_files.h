// result.json, metrics.json and junit.xml. README.md is the spec.
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>

#include "harness/experiment/experiment_fixture.h"
#include "harness/judge/judge.h"
#include "harness/lockstep/run_outcome.h"

namespace towbench::harness {

// An image that runs in the controller's place, as the run folder holds it.
struct ImageIdentity {
  std::filesystem::path copy{};  // relative to the folder; empty: only its digest is kept
  std::string name{};
  std::uint64_t bytes = 0;
  std::string sha256{};
};

// What is known of a run before it starts.
struct RunIdentity {
  std::string carrier;             // "in-process", "local", or an address: "can:vcan0"
  std::string clock = "lockstep";  // or "real"
  std::string fidelity = "edges";  // or "digest", "lines"
  std::uint64_t seed = 0;
  std::string started_utc;
  std::filesystem::path experiment_copy;  // relative to the folder
  std::optional<ImageIdentity> image{};
};

// The first result.json: incomplete until the run has been judged.
void write_started(const std::filesystem::path& folder, const ExperimentFixture& fixture,
                   const RunIdentity& identity);
// The last one of a run that was cut short.
void write_incomplete(const std::filesystem::path& folder, const ExperimentFixture& fixture,
                      const RunIdentity& identity, const RunOutcome& outcome);
// All three files of a run that was judged.
void write_judged(const std::filesystem::path& folder, const ExperimentFixture& fixture,
                  const RunIdentity& identity, const RunOutcome& outcome,
                  const Judgement& judgement);

}  // namespace towbench::harness
