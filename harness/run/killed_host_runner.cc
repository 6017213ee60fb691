#include "harness/run/killed_host_runner.h"

#include "harness/link/killed_host.h"
#include "harness/run/child_runner.h"

namespace towbench::harness {

RunOutcome KilledHostRunner::play() {
  host_was_killed_ = run_until_killed([this] { (void)LockstepChildRunner(plan()).play(); });
  RunOutcome outcome;
  outcome.complete = true;
  outcome.reason = host_was_killed_ ? "the controller's process was killed" : "";
  return outcome;
}

}  // namespace towbench::harness
