#include "harness/run/external_runner.h"

#include "harness/external/external_run.h"

namespace towbench::harness {

RunOutcome ExternalRunner::play() {
  return plan().external->play(plan().folder);
}

void ExternalRunner::judge_into(RunResult& result, const RunOutcome& outcome) {
  plan().external->keep_reference(plan().folder);
  Runner::judge_into(result, outcome);
  plan().external->judge_into(plan().folder, outcome, result.judgement);
  result.timing = plan().external->judge_timing_into(plan().folder, result.judgement);
}

}  // namespace towbench::harness
