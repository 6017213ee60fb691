// For work that writes nothing until its end: Ctrl-C and SIGTERM end the process at once.
#pragma once

#include <csignal>

namespace towbench::study {

// While it lives either signal ends the process with kExitRuntime and one line.
class LeaveOnSignal {
 public:
  LeaveOnSignal();
  LeaveOnSignal(const LeaveOnSignal&) = delete;
  LeaveOnSignal& operator=(const LeaveOnSignal&) = delete;
  ~LeaveOnSignal();

 private:
  struct sigaction interrupt_before_ {};
  struct sigaction terminate_before_ {};
};

}  // namespace towbench::study
