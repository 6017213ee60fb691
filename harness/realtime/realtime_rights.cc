#include "harness/realtime/realtime_rights.h"

#include <algorithm>
#include <charconv>
#include <fstream>

#include <pthread.h>
#include <sched.h>
#include <sys/mman.h>

namespace towbench::harness {
namespace {

// "1-3,5", as the kernel writes a set of processors.
std::vector<int> processors_in(std::string_view text) {
  std::vector<int> processors;
  const char* at = text.data();
  const char* const end = text.data() + text.size();
  while (at < end) {
    int first = 0;
    const auto begin = std::from_chars(at, end, first);
    if (begin.ec != std::errc()) {
      break;
    }
    int last = first;
    at = begin.ptr;
    if (at < end && *at == '-') {
      at = std::from_chars(at + 1, end, last).ptr;
    }
    for (int cpu = first; cpu <= last && cpu < CPU_SETSIZE; ++cpu) {
      processors.push_back(cpu);
    }
    at += at < end && *at == ',' ? 1 : 0;
  }
  return processors;
}

std::string isolated_processors() {
  std::ifstream stream("/sys/devices/system/cpu/isolated");
  std::string line;
  std::getline(stream, line);
  return line;
}

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

std::vector<int> processors_for_loops(std::vector<int> allowed, std::string_view isolated) {
  const auto kept_free = processors_in(isolated);
  allowed.erase(std::remove_if(allowed.begin(), allowed.end(),
                               [&](int cpu) {
                                 return std::find(kept_free.begin(), kept_free.end(), cpu) !=
                                        kept_free.end();
                               }),
                allowed.end());
  allowed.insert(allowed.end(), kept_free.begin(), kept_free.end());
  return allowed;
}

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
  for (const auto& choice : {processors_for_loops(allowed, isolated_processors()), allowed}) {
    if (choice.size() >= 2 && rights.processor < 0) {
      const int cpu = choice[choice.size() - 1 - processor_from_last % choice.size()];
      rights.processor = pin_to(cpu) ? cpu : -1;
    }
  }
  if (rights.processor < 0) {
    rights.warnings.emplace_back(
        "not pinned to a processor: a wake-up may move between processors");
  }
  return rights;
}

}  // namespace towbench::harness
