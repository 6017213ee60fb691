// One run in this process and in memory, with faults or without: cheap enough for thousands.
#pragma once

#include <cstdint>
#include <memory>
#include <optional>

#include "harness/experiment/experiment_fixture.h"
#include "harness/fault_cases/case_link.h"
#include "harness/fault_cases/case_record.h"
#include "harness/lockstep/injection.h"
#include "harness/lockstep/operator.h"

namespace towbench::harness {

// The experiment without expectations: what the console answers is judged afterwards, and a machine
// that fails may answer anything. Its own events stay; so does one that was driven by hand.
[[nodiscard]] ExperimentFixture without_expectations(const ExperimentFixture& fixture);

struct CaseOptions {
  std::uint64_t seed = 1;
  std::optional<FullReverse> reverse{};
  std::optional<double> until_s{};   // instead of the experiment's own limit
  Operator* run_operator = nullptr;  // null: the experiment's own, if it has one
};

// `built` is the fixture's rig with what the plan builds in.
[[nodiscard]] std::unique_ptr<CaseRecord> run_case(const ExperimentFixture& fixture,
                                                   const emulator::RigParameters& built,
                                                   const Injection& injection,
                                                   const CaseOptions& options);

}  // namespace towbench::harness
