// From a failing run with faults to the smallest that still fails in the same way: fewer faults,
// fewer console lines and events, shorter and slower motions, round figures.
//
// Greedy and deterministic: one simplification after the other is tried and kept when the same
// requirement is still broken, until none is. Every trial is a whole run with its fault-free
// reference run.
#pragma once

#include <cstddef>
#include <functional>
#include <string>
#include <vector>

#include "harness/checks/check.h"
#include "harness/experiment/experiment_fixture.h"

namespace towbench::harness {

struct ShrunkCase {
  ExperimentFixture fixture;  // its own text is that of the smaller experiment
  std::string rule;           // the requirement that both break
  std::string reason;         // as broken by the smaller one
  std::size_t trials = 0;
};

// What is judged of one run with its faults. FixtureError: it cannot be run.
using CaseJudge = std::function<std::vector<Check>(const ExperimentFixture&)>;

// Throws FixtureError when the experiment has no faults, or breaks no requirement.
[[nodiscard]] ShrunkCase shrink(const ExperimentFixture& failing, const CaseJudge& judge);
// Of BBMC, in memory.
[[nodiscard]] ShrunkCase shrink(const ExperimentFixture& failing, std::uint64_t seed);

}  // namespace towbench::harness
