// The faults that a search may choose from: each variable of a plan, and what a point of the unit
// box means.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "harness/falsify/box_search.h"
#include "harness/fault_plan/fault.h"

namespace towbench::harness {

struct FaultChoice {
  FaultPlace place{};
  FaultKind kind = FaultKind::kPressed;
  [[nodiscard]] std::string name() const;  // "encoder.y frozen"
};

// Those that the words name, on axes that exist: "encoder.y frozen", "frozen", "encoder.y";
// empty: every one. Without those that a machine has from the start or that strike the record
// alone. Throws FixtureError for a word that names none.
[[nodiscard]] std::vector<FaultChoice> fault_choices(const std::vector<std::string>& words,
                                                     const core::PerAxis<bool>& exists);

struct SearchVariable {
  std::string name;  // "at_s", "duration_s", a parameter's key; of a second fault with "second "
  double from = 0;
  double to = 1;
  bool logarithmic = false;
  bool whole = false;     // whole numbers alone
  bool may_last = false;  // in the last fifth: to the end of the run
};

class FaultSpace {
 public:
  // Onsets from 0 to `end_s`.
  FaultSpace(std::vector<FaultChoice> faults, double end_s);

  [[nodiscard]] const std::vector<SearchVariable>& variables() const noexcept { return variables_; }
  [[nodiscard]] FaultPlan plan_at(const BoxPoint& point) const;
  [[nodiscard]] std::string name() const;

 private:
  std::vector<FaultChoice> faults_;
  std::vector<SearchVariable> variables_;
};

}  // namespace towbench::harness
