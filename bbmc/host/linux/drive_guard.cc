#include "bbmc/host/linux/drive_guard.h"

#include <array>
#include <cerrno>
#include <csignal>

#include <poll.h>
#include <sched.h>
#include <sys/prctl.h>
#include <sys/socket.h>
#include <sys/wait.h>
#include <unistd.h>

namespace towbench::bbmc {
namespace {

// Above the controller and on any processor: one that spins at its priority must not keep the guard
// from running. Where that is refused the guard is an ordinary process.
void rise_above_the_controller() noexcept {
  sched_param order{};
  if (::sched_getparam(0, &order) == 0 && ::sched_getscheduler(0) == SCHED_FIFO) {
    ++order.sched_priority;
    ::sched_setscheduler(0, SCHED_FIFO, &order);
  }
  cpu_set_t all;
  CPU_ZERO(&all);
  for (std::size_t processor = 0; processor < CPU_SETSIZE; ++processor) {
    CPU_SET(processor, &all);
  }
  ::sched_setaffinity(0, sizeof all, &all);
}

// The guard's whole life. Nothing but system calls: other threads of the process that it was forked
// from may have held any lock.
[[noreturn]] void watch(int line, int patience_ms, LinuxBoard& board) noexcept {
  // Ctrl-C is for the controller, which stops the machine first.
  for (const int signal : {SIGINT, SIGTERM, SIGHUP}) {
    ::signal(signal, SIG_IGN);
  }
  ::prctl(PR_SET_NAME, "towbench-guard");
  rise_above_the_controller();
  std::array<char, 256> signs{};
  pollfd waiting{.fd = line, .events = POLLIN, .revents = 0};
  for (;;) {
    const int ready = ::poll(&waiting, 1, patience_ms);
    if (ready < 0 && errno == EINTR) {
      continue;
    }
    if (ready <= 0 || ::read(line, signs.data(), signs.size()) <= 0) {
      break;
    }
  }
  board.make_safe();
  ::_exit(0);
}

}  // namespace

core::Status DriveGuard::post(LinuxBoard& board, core::Nanoseconds patience_ns) noexcept {
  std::array<int, 2> ends{-1, -1};
  if (::socketpair(AF_UNIX, SOCK_STREAM | SOCK_NONBLOCK | SOCK_CLOEXEC, 0, ends.data()) != 0) {
    return core::failure(core::ErrorCode::kTransportFailed);
  }
  process_ = ::fork();
  if (process_ == 0) {
    ::close(ends[1]);
    watch(ends[0], static_cast<int>(patience_ns / core::kNanosecondsPerMillisecond), board);
  }
  ::close(ends[0]);
  line_ = ends[1];
  if (process_ < 0) {
    dismiss();
    return core::failure(core::ErrorCode::kTransportFailed);
  }
  return {};
}

core::Status DriveGuard::alive() noexcept {
  const char sign = '.';
  // A full line means that the guard has not run for a while; what waits in it keeps it patient.
  const bool sent = ::send(line_, &sign, 1, MSG_NOSIGNAL) == 1 || errno == EAGAIN;
  return sent ? core::Status() : core::failure(core::ErrorCode::kPeerClosed);
}

void DriveGuard::dismiss() noexcept {
  if (line_ >= 0) {
    ::close(line_);
    line_ = -1;
  }
  if (process_ > 0) {
    ::waitpid(process_, nullptr, 0);
    process_ = -1;
  }
}

}  // namespace towbench::bbmc
