#include "harness/foreign_plant/plant_host.h"

#include <algorithm>
#include <cerrno>
#include <csignal>
#include <cstdlib>
#include <cstring>
#include <system_error>

#include <fcntl.h>
#include <sys/prctl.h>
#include <sys/resource.h>
#include <unistd.h>

namespace towbench::harness {
namespace {

void tell(Mailbox& mailbox, const std::string& why) {
  const auto length = std::min(why.size(), mailbox.message.size() - 1);
  std::memcpy(mailbox.message.data(), why.data(), length);
  mailbox.message[length] = '\0';
}

bool save(LoadedPlant& plant, Mailbox& mailbox) {
  mailbox.state_size = plant.state_size();
  if (mailbox.state_size == 0 || mailbox.state_size > mailbox.state.size()) {
    tell(mailbox,
         mailbox.state_size == 0 ? "offers no saved state" : "has a state of more than 1 MiB");
    return false;
  }
  return plant.save(mailbox.state.data());
}

bool carry_out(LoadedPlant& plant, Mailbox& mailbox) {
  switch (mailbox.order) {
    case PlantOrder::kStep:
      return plant.step(mailbox.until_s, mailbox.inputs.data(), mailbox.outputs.data(),
                        mailbox.reached_s, mailbox.message.data(), mailbox.message.size());
    case PlantOrder::kSave:
      return save(plant, mailbox);
    case PlantOrder::kRestore:
      return plant.restore(mailbox.state.data());
    case PlantOrder::kEnd:
      break;
  }
  return true;
}

// Nothing of the bench's reaches the binary but the mailbox, and what it prints goes to stderr.
void leave_the_bench(pid_t parent) {
  prctl(PR_SET_PDEATHSIG, SIGKILL);
  if (getppid() != parent) {
    _exit(EXIT_FAILURE);
  }
  (void)setpgid(0, 0);  // Ctrl-C is for the bench
  for (const int signal : {SIGINT, SIGTERM, SIGHUP, SIGPIPE, SIGSEGV, SIGBUS, SIGFPE, SIGILL,
                           SIGABRT, SIGCHLD, SIGALRM}) {
    (void)std::signal(signal, SIG_DFL);
  }
  const rlimit none{.rlim_cur = 0, .rlim_max = 0};
  (void)setrlimit(RLIMIT_CORE, &none);
  if (const int nothing = open("/dev/null", O_RDONLY); nothing >= 0) {
    (void)dup2(nothing, STDIN_FILENO);
  }
  (void)dup2(STDERR_FILENO, STDOUT_FILENO);
  (void)close_range(STDERR_FILENO + 1, ~0U, 0);
}

[[noreturn]] void serve(const PlantBinary& binary, const std::vector<PlantAxis>& axes,
                        Mailbox& mailbox) {
  std::string why;
  auto plant = binary.load(axes, why);
  tell(mailbox, why);
  mailbox.succeeded = plant != nullptr;
  std::uint32_t served = 0;
  mailbox.answers.post(served + 1);
  while (plant) {
    while (!mailbox.requests.changes_from(served, -1)) {
    }
    ++served;
    mailbox.message.front() = '\0';
    if (mailbox.order == PlantOrder::kEnd) {
      plant.reset();
    } else {
      mailbox.succeeded = carry_out(*plant, mailbox);
      mailbox.message.back() = '\0';
    }
    mailbox.answers.post(served + 1);
  }
  _exit(EXIT_SUCCESS);
}

}  // namespace

pid_t start_plant_host(const PlantBinary& binary, const std::vector<PlantAxis>& axes,
                       Mailbox& mailbox) {
  const auto parent = getpid();
  const auto child = fork();
  if (child < 0) {
    throw std::system_error(errno, std::generic_category(), "fork");
  }
  if (child == 0) {
    try {
      leave_the_bench(parent);
      serve(binary, axes, mailbox);
    } catch (...) {
      _exit(EXIT_FAILURE);
    }
  }
  return child;
}

}  // namespace towbench::harness
