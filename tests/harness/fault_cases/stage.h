// One motion and its fault-free run, shared by every fault that a test tries on it.
#pragma once

#include <map>
#include <memory>
#include <string>

#include "harness/fault_cases/case_run.h"
#include "harness/fault_cases/fault_case.h"
#include "harness/fault_plan/fault_text.h"
#include "tests/harness/end_to_end/run_support.h"

namespace towbench::harness {

struct Stage {
  explicit Stage(const std::string& experiment)
      : plain(without_expectations(Runs::shipped(experiment))),
        reference(run_reference(plain, 1)) {}
  ExperimentFixture plain;
  std::unique_ptr<CaseRecord> reference;

  CaseVerdict carry_out(const std::string& words, std::unique_ptr<CaseRecord>* run = nullptr) {
    const auto prepared = prepare({parse_fault(words)}, plain, *reference);
    return judge_case(plain, prepared, *reference, 1, run);
  }
};

inline Stage& stage(const std::string& experiment) {
  static std::map<std::string, Stage> stages;
  return stages.try_emplace(experiment, experiment).first->second;
}

inline std::string words_of(const CaseVerdict& verdict) {
  std::string text;
  for (const auto& check : verdict.checks) {
    if (check.verdict != Verdict::kPass) {
      text += check.name + ": " + check.reason + "\n";
    }
  }
  return text;
}

}  // namespace towbench::harness
