#include "harness/run/runner.h"

#include "harness/run/board_runner.h"
#include "harness/run/child_runner.h"
#include "harness/run/external_runner.h"
#include "harness/run/in_process_runner.h"
#include "harness/run/killed_host_runner.h"
#include "harness/run/real_time_runner.h"

namespace towbench::harness {

void Runner::judge_into(RunResult& result, const RunOutcome& outcome) {
  result.judgement = judge(plan_.folder, plan_.fixture, outcome);
}

std::unique_ptr<Runner> make_runner(const RunPlan& plan) {
  switch (plan.kind) {
    case RunKind::kInProcess:
      return std::make_unique<InProcessRunner>(plan);
    case RunKind::kBoard:
      return std::make_unique<BoardRunner>(plan);
    case RunKind::kExternal:
      return std::make_unique<ExternalRunner>(plan);
    case RunKind::kKilledHost:
      return std::make_unique<KilledHostRunner>(plan);
    case RunKind::kChildProcess:
      break;
  }
  if (plan.options.clock == RunClock::kReal) {
    return std::make_unique<RealTimeRunner>(plan);
  }
  return std::make_unique<LockstepChildRunner>(plan);
}

}  // namespace towbench::harness
