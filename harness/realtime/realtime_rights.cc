#include "harness/realtime/realtime_rights.h"

#include <pthread.h>
#include <sched.h>
#include <sys/mman.h>

namespace towbench::harness {
namespace {

std::vector<int> processors_allowed() {
  std::vector<int> allowed;
  cpu_set_t set;
  CPU_ZERO(&set);
  if (::sched_getaffinity(0, sizeof(set), &set) == 0) {
    for (std::size_t cpu = 0; cpu < CPU_SETSIZE; ++cpu) {
      if (CPU_ISSET(cpu, &set)) {
        allowed.push_back(static_cast<int>(cpu));
      }
    }
  }
  return allowed;
}

bool pin_to(int cpu) {
  cpu_set_t set;
  CPU_ZERO(&set);
  CPU_SET(static_cast<std::size_t>(cpu), &set);
  return ::pthread_setaffinity_np(::pthread_self(), sizeof(set), &set) == 0;
}

}  // namespace

std::string RealtimeRights::text() const {
  return (has_fifo ? "SCHED_FIFO " + std::to_string(priority) : std::string("no fixed priority")) +
         (has_locked_memory ? ", memory locked" : ", memory not locked") +
         (processor >= 0 ? ", processor " + std::to_string(processor) : ", not pinned");
}

RealtimeRights take_realtime_rights(int priority, unsigned processor_from_last) {
  RealtimeRights rights;
  sched_param parameters{};
  parameters.sched_priority = priority;
  rights.has_fifo = ::pthread_setschedparam(::pthread_self(), SCHED_FIFO, &parameters) == 0;
  if (rights.has_fifo) {
    rights.priority = priority;
  } else {
    rights.warnings.emplace_back(
        "no right to SCHED_FIFO: ticks will come late; run as root, or give the user rtprio in "
        "/etc/security/limits.conf, or setcap cap_sys_nice+ep");
  }
  rights.has_locked_memory = ::mlockall(MCL_CURRENT | MCL_FUTURE) == 0;
  if (!rights.has_locked_memory) {
    rights.warnings.emplace_back(
        "memory is not locked: a page fault may delay a tick; raise memlock in "
        "/etc/security/limits.conf");
  }
  const auto allowed = processors_allowed();
  if (allowed.size() >= 2) {
    const int cpu = allowed[allowed.size() - 1 - processor_from_last % allowed.size()];
    rights.processor = pin_to(cpu) ? cpu : -1;
  }
  if (rights.processor < 0) {
    rights.warnings.emplace_back(
        "not pinned to a processor: a wake-up may move between processors");
  }
  return rights;
}

}  // namespace towbench::harness
