// The controller is an image on the virtual board, the plant in this process.
#pragma once

#include "harness/run/runner.h"

namespace towbench::harness {

class BoardRunner final : public Runner {
 public:
  using Runner::Runner;
  [[nodiscard]] RunOutcome play() override;
  void judge_into(RunResult& result, const RunOutcome& outcome) override;
};

}  // namespace towbench::harness
