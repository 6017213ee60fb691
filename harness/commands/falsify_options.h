// What the options of `towbench falsify` mean, checked.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "harness/campaign/candidate_controller.h"
#include "harness/falsify/box_search.h"
#include "harness/falsify/objective.h"
#include "harness/falsify/setup.h"

namespace towbench::harness {

struct FalsifyOptions {
  std::vector<std::string> experiments;
  std::string requirement;
  std::vector<std::string> faults;
  std::vector<std::string> except;
  std::string second;
  SetupRanges setup;
  std::vector<double> speed;
  std::string budget = "2000 runs";
  std::string optimiser = "sbplx";
  std::string controller;
  std::string out;
  std::string keep;
  std::uint64_t seed = 1;
  std::size_t snapshots = 0;
  std::string shard = "1/1";
  std::size_t workers = 1;
  std::size_t slurm = 0;
  std::vector<std::string> slurm_options;
  bool until_broken = false;
  bool fresh = false;
  bool quiet = false;
};

struct SearchBudget {
  std::size_t runs = 0;
  double time_s = 0;  // 0: as long as the runs take
};

// Each throws FixtureError for what is not allowed.
[[nodiscard]] SearchBudget parse_budget(const std::string& text);
[[nodiscard]] Optimiser optimiser_named(const std::string& text);
[[nodiscard]] Asked asked_of(const FalsifyOptions& options, const Experiment& experiment);
[[nodiscard]] CandidateController candidate_of(const std::string& text);
// Without a fault the setup alone is searched.
[[nodiscard]] bool searches_no_fault(const FalsifyOptions& options);
// Takes the range of speeds into the setup.
void check_setup(FalsifyOptions& options, const ExperimentFixture& fixture, const Asked& asked,
                 const CandidateController& controller);

}  // namespace towbench::harness
