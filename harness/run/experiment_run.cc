#include "harness/run/experiment_run.h"

#include "harness/proof/run_manifest.h"
#include "harness/record/event_lines.h"
#include "harness/record/logger_file.h"
#include "harness/record/result_files.h"
#include "harness/run/run_plan.h"
#include "harness/run/runner.h"

namespace towbench::harness {
namespace {

void judge_complete(const RunPlan& plan, Runner& runner, RunResult& result) {
  merge_events(plan.folder);
  runner.judge_into(result, result.outcome);
  if (plan.has_faults()) {
    result.faults = plan.faults->judge_into(plan.folder,
                                            {.writes_succeeded = result.outcome.writes_succeeded,
                                             .host_was_killed = runner.host_was_killed()},
                                            result.judgement);
  }
  write_logger_file(plan.folder, plan.fixture.experiment.logger_rate_Hz);
  write_judged(plan.folder, plan.fixture, plan.identity, result.outcome, result.judgement);
  result.exit_code = exit_code_of(result.judgement.verdict);
}

}  // namespace

RunResult run_experiment(const ExperimentFixture& fixture, const RunOptions& options) {
  auto plan = plan_run(fixture, options);
  begin_record(plan);
  const auto runner = make_runner(plan);
  auto outcome = runner->play();
  if (outcome.control_period_ns == 0) {  // a third-party image has rows of another distance
    outcome.control_period_ns = plan.fixture.controller.configuration.control_period_ns();
  }
  outcome.complete = outcome.complete || plan.may_end_early();
  if (options.run_operator != nullptr) {
    plan.take_over(*options.run_operator);
  }
  RunResult result;
  result.folder = plan.folder;
  result.complete = outcome.complete;
  result.reason = outcome.reason;
  result.outcome = outcome;
  if (outcome.complete) {
    judge_complete(plan, *runner, result);
  } else {
    write_incomplete(plan.folder, plan.fixture, plan.identity, outcome);
  }
  write_manifest(plan.folder);
  return result;
}

}  // namespace towbench::harness
