// The controller is a program that the bench did not write, the plant is in this process.
#pragma once

#include "harness/run/runner.h"

namespace towbench::harness {

class ExternalRunner final : public Runner {
 public:
  using Runner::Runner;
  [[nodiscard]] RunOutcome play() override;
  void judge_into(RunResult& result, const RunOutcome& outcome) override;
};

}  // namespace towbench::harness
