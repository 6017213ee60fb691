#include "harness/panel/turns.h"

#include <sched.h>

namespace towbench::harness {
namespace {

// Between these two no right is needed; where the kernel refuses all the same, all are equal.
void schedule_as(int policy) noexcept {
  const sched_param no_priority{};
  (void)::sched_setscheduler(0, policy, &no_priority);
}

}  // namespace

void look_on() noexcept {
  schedule_as(SCHED_BATCH);
}
void take_turns() noexcept {
  schedule_as(SCHED_OTHER);
}

}  // namespace towbench::harness
