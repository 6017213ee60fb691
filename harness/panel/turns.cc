#include "harness/panel/turns.h"

#include <algorithm>

#include <sched.h>
#include <sys/resource.h>

namespace towbench::harness {
namespace {

// As this program was started, asked before anything is changed.
int own_nice() noexcept {
  static const int nice = ::getpriority(PRIO_PROCESS, 0);
  return nice;
}

// Changing between these two policies takes no right, being less nice does. Where the kernel
// refuses, all are equal.
void schedule_as(int policy, int nice) noexcept {
  const sched_param no_priority{};
  (void)::sched_setscheduler(0, policy, &no_priority);
  (void)::setpriority(PRIO_PROCESS, 0, nice);
}

}  // namespace

void observe_only() noexcept {
  schedule_as(SCHED_BATCH, own_nice());
}
void share_processor() noexcept {
  const int nice = own_nice();
  schedule_as(SCHED_OTHER, std::min(nice, kAhead));
}

}  // namespace towbench::harness
