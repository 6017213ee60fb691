// Whether estimates agree with what the emulated machine truly is. Looks at the rig's fixture,
// after everything has been estimated; no estimator can reach it.
//
// ID-0: "recover p %" means that the value agrees within p %, that 95 % intervals cover
// in 92 to 98 % of at least 400 estimates pooled, and that an interval wider than 4 p % is a
// failure too.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "emulator/rig_parameters.h"
#include "study/identify/estimate.h"

namespace towbench::study {

struct Recovery {
  identify::Estimate estimate;
  double truth = 0;
  double tolerance_pct = 0;  // p
  double error_pct = 0;      // of the truth, signed
  double width_pct = 0;      // of the whole interval
  bool agrees = false;
  bool narrow = false;   // width below 4 p
  bool covered = false;  // low <= truth <= high
};

// What a quantity truly is; none when the quantity has no truth in a rig's parameters. Friction
// without a place is that of the lowest place of the track; `at` is a place in m.
[[nodiscard]] std::optional<double> truth_of(const emulator::RigParameters& rig,
                                             const identify::Estimate& estimate);

// Of every estimate that has a truth and a demand on it, in their order.
[[nodiscard]] std::vector<Recovery> judge_recovery(const emulator::RigParameters& rig,
                                                   const identify::Estimates& estimates);

struct PooledCoverage {
  std::size_t estimates = 0;
  std::size_t covered = 0;
  [[nodiscard]] double share() const noexcept {
    return estimates == 0 ? 0.0 : static_cast<double>(covered) / static_cast<double>(estimates);
  }
};
[[nodiscard]] PooledCoverage pooled(const std::vector<Recovery>& recoveries);

}  // namespace towbench::study
