// What a search may vary besides faults: the machine, where it starts, how fast it is asked to
// move, and a line that an operator types.
#pragma once

#include <optional>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "harness/experiment/changed_machine.h"
#include "harness/falsify/search_variable.h"

namespace towbench::harness {

struct SetupRanges {
  double machine = 0;  // each uncertain quantity of each axis up to so much more or less, relative
  double start_m = 0;  // each axis starts up to so much to either side
  std::pair<double, double> speed = {1, 1};  // times what the experiment states, log-uniform
  std::string typed{};                       // at any moment; empty: nothing
};

struct Setup {
  std::optional<MachineFactors> machine{};
  core::PerAxis<double> start_offset_m{};
  double speed = 1;
  std::string typed{};
  double typed_at_s = 0;

  // As the experiment's files say.
  [[nodiscard]] bool is_nominal() const noexcept;
};

class SetupSpace {
 public:
  SetupSpace() = default;
  // Lines are typed from 0 to `end_s`.
  SetupSpace(SetupRanges ranges, const core::PerAxis<bool>& exists, double end_s);

  [[nodiscard]] const std::vector<SearchVariable>& variables() const noexcept { return variables_; }
  // Shares of each variable's range, as many as there are variables.
  [[nodiscard]] Setup at(std::span<const double> shares) const;

 private:
  SetupRanges ranges_{};
  core::PerAxis<bool> exists_{};
  std::vector<SearchVariable> variables_;
};

// What differs from the experiment's files, one phrase each.
[[nodiscard]] std::vector<std::string> describe(const Setup& setup);

// The experiment in that setup, written into `folder` with a rig of its own where the machine
// differs, and read again. A start moves with what BBMC is told of it (`reset poscalib`); its
// script waits for no answers when a line is typed. Throws FixtureError.
[[nodiscard]] ExperimentFixture in_setup(const ExperimentFixture& fixture, const Setup& setup,
                                         const std::filesystem::path& folder);

}  // namespace towbench::harness
