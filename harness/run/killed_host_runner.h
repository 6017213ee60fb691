// The controller's side in a process that a fault kills; the plant's process sees it go.
#pragma once

#include "harness/run/runner.h"

namespace towbench::harness {

class KilledHostRunner final : public Runner {
 public:
  using Runner::Runner;
  [[nodiscard]] RunOutcome play() override;
  // What a record that ends in the middle is worth, only its faults' requirements say.
  void judge_into(RunResult& /*result*/, const RunOutcome& /*outcome*/) override {}
  [[nodiscard]] bool host_was_killed() const noexcept override { return host_was_killed_; }

 private:
  bool host_was_killed_ = false;
};

}  // namespace towbench::harness
