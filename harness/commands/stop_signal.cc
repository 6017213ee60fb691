#include "harness/commands/stop_signal.h"

#include <csignal>

namespace towbench::harness {
namespace {

std::atomic<bool> stop{false};
static_assert(std::atomic<bool>::is_always_lock_free, "a signal handler may not lock");

void request_stop(int /*signal*/) {
  stop.store(true, std::memory_order_relaxed);
}

void install() {
  struct sigaction action {};
  action.sa_handler = request_stop;
  sigemptyset(&action.sa_mask);
  // No SA_RESTART: a wait in a system call ends and sees the flag.
  sigaction(SIGINT, &action, nullptr);
  sigaction(SIGTERM, &action, nullptr);
  struct sigaction before {};
  sigaction(SIGHUP, nullptr, &before);
  if (before.sa_handler != SIG_IGN) {  // nohup
    sigaction(SIGHUP, &action, nullptr);
  }
}

}  // namespace

const std::atomic<bool>& stop_requested() {
  static const bool installed = (install(), true);
  (void)installed;
  return stop;
}

}  // namespace towbench::harness
