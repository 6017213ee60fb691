#include "study/commands/leave_on_signal.h"

#include <string_view>

#include <unistd.h>

#include "harness/checks/check.h"

namespace towbench::study {
namespace {

// Nothing but what a signal handler may call.
void leave(int /*signal*/) {
  constexpr std::string_view kLine = "towbench: stopped before its end, nothing was written\n";
  [[maybe_unused]] const auto written = write(STDERR_FILENO, kLine.data(), kLine.size());
  _exit(harness::kExitRuntime);
}

}  // namespace

LeaveOnSignal::LeaveOnSignal() {
  struct sigaction action {};
  action.sa_handler = leave;
  sigemptyset(&action.sa_mask);
  sigaction(SIGINT, &action, &interrupt_before_);
  sigaction(SIGTERM, &action, &terminate_before_);
}

LeaveOnSignal::~LeaveOnSignal() {
  sigaction(SIGINT, &interrupt_before_, nullptr);
  sigaction(SIGTERM, &terminate_before_, nullptr);
}

}  // namespace towbench::study
