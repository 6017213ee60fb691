#include "harness/link/killed_host.h"

#include <array>
#include <cerrno>
#include <csignal>
#include <system_error>

#include <poll.h>
#include <sys/wait.h>
#include <unistd.h>

namespace towbench::harness {

bool run_until_killed(const std::function<void()>& side) {
  std::array<int, 2> alive{};
  if (pipe(alive.data()) != 0) {
    throw std::system_error(errno, std::generic_category(), "pipe");
  }
  const pid_t host = fork();
  if (host < 0) {
    throw std::system_error(errno, std::generic_category(), "fork");
  }
  if (host == 0) {
    close(alive[0]);
    side();
    _exit(0);
  }
  close(alive[1]);
  int status = 0;
  waitpid(host, &status, 0);
  constexpr int kPlantNotices_ms = 5000;
  pollfd ended{alive[0], POLLIN, 0};
  (void)poll(&ended, 1, kPlantNotices_ms);
  close(alive[0]);
  return WIFSIGNALED(status) && WTERMSIG(status) == SIGKILL;
}

}  // namespace towbench::harness
