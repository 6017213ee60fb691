// Controller and plant in this process.
#pragma once

#include "harness/run/runner.h"

namespace towbench::harness {

class InProcessRunner final : public Runner {
 public:
  using Runner::Runner;
  [[nodiscard]] RunOutcome play() override;
};

}  // namespace towbench::harness
