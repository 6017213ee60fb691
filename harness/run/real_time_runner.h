// Both processes by the wall clock.
#pragma once

#include <optional>

#include "harness/realtime/run_timing.h"
#include "harness/run/child_runner.h"

namespace towbench::harness {

class RealTimeRunner final : public ChildRunner {
 public:
  using ChildRunner::ChildRunner;
  void judge_into(RunResult& result, const RunOutcome& outcome) override;

 private:
  [[nodiscard]] RunOutcome play_over(EmulatorProcess& child, protocol::Connection& connection,
                                     CanLog* log) override;

  std::optional<ControllerTiming> timing_;  // from the connection on
};

}  // namespace towbench::harness
