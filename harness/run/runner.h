// Carries a plan out and judges it: one of these for each kind of run.
#pragma once

#include <memory>

#include "harness/run/run_plan.h"

namespace towbench::harness {

class Runner {
 public:
  // The plan outlives this.
  explicit Runner(const RunPlan& plan) : plan_(plan) {}
  Runner(const Runner&) = delete;
  Runner& operator=(const Runner&) = delete;
  virtual ~Runner() = default;

  // From the handshake to the end; both sides' records are in the folder afterwards.
  [[nodiscard]] virtual RunOutcome play() = 0;
  // Of a complete run: the experiment's budgets and the record's integrity, and whatever else this
  // kind of run is judged by.
  virtual void judge_into(RunResult& result, const RunOutcome& outcome);
  // Whether the controller's process was killed, as planned.
  [[nodiscard]] virtual bool host_was_killed() const noexcept { return false; }

 protected:
  [[nodiscard]] const RunPlan& plan() const noexcept { return plan_; }

 private:
  const RunPlan& plan_;
};

// The one for the plan's kind.
[[nodiscard]] std::unique_ptr<Runner> make_runner(const RunPlan& plan);

}  // namespace towbench::harness
