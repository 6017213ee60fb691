// What a search may choose from: faults with each variable of theirs, a setup, and what a point of
// the unit box means.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "harness/falsify/box_sampler.h"
#include "harness/falsify/search_variable.h"
#include "harness/falsify/setup.h"
#include "harness/fault_plan/fault.h"

namespace towbench::harness {

struct FaultChoice {
  FaultPlace place{};
  FaultKind kind = FaultKind::kPressed;
  bool operator==(const FaultChoice&) const = default;
  [[nodiscard]] std::string name() const;  // "encoder.y frozen"
};

// Those that the words name, on axes that exist: "encoder.y frozen", "frozen", "encoder.y";
// empty: every one. Without those that a machine has from the start or that strike the record
// alone. Throws FixtureError for a word that names none.
[[nodiscard]] std::vector<FaultChoice> fault_choices(const std::vector<std::string>& words,
                                                     const core::PerAxis<bool>& exists);

// One point of a search.
struct SearchCase {
  FaultPlan faults{};
  Setup setup{};
  // In words: what fails, and what differs from the experiment's files.
  [[nodiscard]] std::vector<std::string> words() const;
};

class FaultSpace {
 public:
  // Onsets from 0 to `end_s`; `phases` of the motion that they go by, one for each fault or none.
  FaultSpace(std::vector<FaultChoice> faults, double end_s, SetupSpace setup = {},
             const std::vector<std::vector<Stretch>>& phases = {});

  [[nodiscard]] const std::vector<SearchVariable>& variables() const noexcept { return variables_; }
  [[nodiscard]] std::vector<BoxSide> sides() const;
  [[nodiscard]] FaultPlan plan_at(const BoxPoint& point) const;
  [[nodiscard]] SearchCase case_at(const BoxPoint& point) const;
  [[nodiscard]] std::string name() const;

 private:
  std::vector<FaultChoice> faults_;
  SetupSpace setup_;
  std::vector<SearchVariable> variables_;
};

}  // namespace towbench::harness
