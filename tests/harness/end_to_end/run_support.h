// Whole runs for tests: into a temporary folder, with what they left behind at hand.
#pragma once

#include <fstream>
#include <sstream>
#include <string>

#include <nlohmann/json.hpp>

#include "harness/files/csv_table.h"
#include "harness/fixtures/canonical_hash.h"
#include "harness/run/experiment_run.h"
#include "tests/harness/fixtures/temporary_fixtures.h"

namespace towbench::harness {

inline std::string contents_of(const std::filesystem::path& path) {
  std::ifstream stream(path, std::ios::binary);
  std::stringstream text;
  text << stream.rdbuf();
  return text.str();
}

inline nlohmann::json json_of(const std::filesystem::path& path) {
  return nlohmann::json::parse(contents_of(path), nullptr, false);
}

class Runs {
 public:
  RunResult run(const ExperimentFixture& fixture, Carrier carrier = Carrier::kInProcess) {
    RunOptions options;
    options.out = files_.folder();
    options.carrier = carrier;
    options.program = TOWBENCH_PROGRAM;
    return run_experiment(fixture, options);
  }
  RunResult run(const std::string& name, Carrier carrier = Carrier::kInProcess) {
    return run(shipped(name), carrier);
  }

  static ExperimentFixture shipped(const std::string& name) {
    return load_experiment("fixtures/experiments/" + name + ".toml");
  }

  [[nodiscard]] const std::filesystem::path& folder() const { return files_.folder(); }

 private:
  TemporaryFixtures files_;
};

// Every check that is not a pass, in words: what a test prints when it fails.
inline std::string complaints_of(const RunResult& run) {
  std::string text = run.reason;
  for (const auto& check : run.judgement.checks) {
    if (check.verdict != Verdict::kPass) {
      text += check.name + ": " + check.reason + "\n";
    }
  }
  return text;
}

inline const Check* check_named(const RunResult& run, std::string_view name) {
  for (const auto& check : run.judgement.checks) {
    if (check.name == name) {
      return &check;
    }
  }
  return nullptr;
}

}  // namespace towbench::harness
