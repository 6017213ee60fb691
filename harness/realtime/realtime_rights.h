// What makes a process fit for real time: fixed priority, locked memory, a processor of its own.
#pragma once

#include <string>
#include <vector>

namespace towbench::harness {

struct RealtimeRights {
  bool has_fifo = false;
  bool has_locked_memory = false;
  int priority = 0;    // 0 without SCHED_FIFO
  int processor = -1;  // pinned to; -1 to none
  // One sentence for each thing that was refused, with how to mend it. Empty when nothing was.
  std::vector<std::string> warnings;

  // "SCHED_FIFO 80, memory locked, processor 1".
  [[nodiscard]] std::string text() const;
};

// For the calling thread. Processors are counted from the last one that this process may use: 0 is
// the last, 1 the one before, and so on round again. What is refused is told, not fatal.
[[nodiscard]] RealtimeRights take_realtime_rights(int priority, unsigned processor_from_last);

}  // namespace towbench::harness
