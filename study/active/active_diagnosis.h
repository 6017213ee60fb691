// Diagnose, run the experiment that separates what is left open on the same rig, diagnose all logs
// together: until one cause is left, or no experiment of the bench tells more.
//
//   out/experiments/NAME.toml   what was asked of the rig, ordinary experiment files
//   out/runs/...                ordinary run folders
//   out/round-N/                the diagnosis before each experiment
//   out/active.json, active.txt what was asked, run and answered; rewritten after every step
//
// Each experiment is run twice: the first run is fitted, the second judged on. Whatever was run to
// its end is found again when the same command is given once more, so a stop loses nothing.
#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <string>
#include <vector>

#include "harness/run/experiment_run.h"
#include "study/active/open_question.h"
#include "study/active/trial.h"
#include "study/diagnose/diagnosis.h"

namespace towbench::study::active {

using Logs = std::vector<std::string>;

// What a known force has shown: commands give `ratio` times less than stated, or everything that
// resists them is `ratio` times more. To every other motion the two are one.
struct Correction {
  enum class Of { kNothing, kAmplifier, kEverythingElse };
  Of of = Of::kNothing;
  double ratio = 1;
};

struct Hands {
  // Diagnoses the logs against the corrected model and writes the result into the folder. Throws
  // when they cannot be.
  std::function<diagnose::Diagnosis(const Logs& data, const Logs& holdout,
                                    const std::filesystem::path& folder, const Correction& known)>
      diagnose;
  std::function<harness::RunResult(const harness::ExperimentFixture& fixture,
                                   const std::filesystem::path& out, std::uint64_t seed)>
      run;
  // The ratio of known_force.h and its interval, from a run folder.
  std::function<diagnose::Interval(const std::string& folder, const Push& push)> weigh_force;
  std::function<void(const std::string& line)> tell;
};

struct Request {
  Logs data;  // the first is a run folder of the bench
  Logs holdout;
  std::filesystem::path rig;  // empty: the run folder's copy
  std::filesystem::path out;
  std::string axis = "y";
  int most_rounds = 3;
};

struct Round {
  std::vector<std::string> asked{};
  std::string motion{};
  std::filesystem::path experiment{};
  std::vector<std::filesystem::path> folders{};
  std::string answer{};  // of all data up to here
};

struct Outcome {
  enum class End { kUnderWay, kOneCause, kNothingSeparates, kOutOfRounds, kRunFailed, kStopped };
  End end = End::kUnderWay;
  std::string first_answer;  // before any experiment
  std::vector<Round> rounds;
  std::string answer;  // names; classes as "a or b"
  std::string why;     // why it stopped there
};

// Throws FixtureError for a log or rig that nothing can be run on.
[[nodiscard]] Outcome diagnose_actively(const Request& request, const Hands& hands);

}  // namespace towbench::study::active
