// What makes a process fit for real time: fixed priority, locked memory, a processor of its own.
#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace towbench::harness {

struct RealtimeRights {
  bool has_fifo = false;
  bool has_locked_memory = false;
  int priority = 0;    // 0 without SCHED_FIFO
  int processor = -1;  // pinned to; -1 to none
  // One sentence for each thing that was refused, with how to correct it. Empty when nothing was.
  std::vector<std::string> warnings;

  // "SCHED_FIFO 80, memory locked, processor 1".
  [[nodiscard]] std::string text() const;
};

// Processors in the order in which loops take them from the end: those that the kernel keeps free
// of everything else ("2-3,5" as in /sys/devices/system/cpu/isolated) come last, although no
// process is allowed on them unless it asks.
[[nodiscard]] std::vector<int> processors_for_loops(std::vector<int> allowed,
                                                    std::string_view isolated);

// For the calling thread. Processors are counted from the last one of these: 0 is the last, 1 the
// one before, and so on round again. What is refused is told, not fatal.
[[nodiscard]] RealtimeRights take_realtime_rights(int priority, unsigned processor_from_last);

}  // namespace towbench::harness
