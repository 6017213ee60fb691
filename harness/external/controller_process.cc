#include "harness/external/controller_process.h"

#include <array>
#include <chrono>
#include <csignal>
#include <cstring>
#include <system_error>
#include <thread>

#include <fcntl.h>
#include <fmt/format.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

namespace towbench::harness {
namespace {

constexpr auto kPatience = std::chrono::milliseconds(2000);

void check(int error, const char* what) {
  if (error != 0) {
    throw std::system_error(error, std::generic_category(), what);
  }
}

}  // namespace

ControllerProcess::ControllerProcess(const std::string& command,
                                     const std::filesystem::path& output) {
  posix_spawn_file_actions_t actions{};
  posix_spawnattr_t attributes{};
  check(posix_spawn_file_actions_init(&actions), "posix_spawn_file_actions_init");
  check(posix_spawnattr_init(&attributes), "posix_spawnattr_init");
  posix_spawn_file_actions_addopen(&actions, STDIN_FILENO, "/dev/null", O_RDONLY, 0);
  posix_spawn_file_actions_addopen(&actions, STDOUT_FILENO, output.c_str(),
                                   O_WRONLY | O_CREAT | O_APPEND, 0644);
  posix_spawn_file_actions_adddup2(&actions, STDOUT_FILENO, STDERR_FILENO);
  posix_spawnattr_setflags(&attributes, POSIX_SPAWN_SETPGROUP);
  std::string shell = "/bin/sh";
  std::string option = "-c";
  std::string words = command;
  std::array<char*, 4> argv{shell.data(), option.data(), words.data(), nullptr};
  const int error =
      posix_spawn(&child_, shell.c_str(), &actions, &attributes, argv.data(), environ);
  posix_spawn_file_actions_destroy(&actions);
  posix_spawnattr_destroy(&attributes);
  check(error, "cannot start the controller's process");
}

ControllerProcess::~ControllerProcess() {
  kill(-child_, SIGKILL);
  if (!ended_) {
    waitpid(child_, &status_, 0);
  }
}

bool ControllerProcess::runs() {
  ended_ = ended_ || waitpid(child_, &status_, WNOHANG) == child_;
  return !ended_;
}

std::string ControllerProcess::join() {
  const auto deadline = std::chrono::steady_clock::now() + kPatience;
  while (runs()) {
    if (std::chrono::steady_clock::now() > deadline) {
      return "did not end after the bench's Bye and was ended";
    }
    std::this_thread::sleep_for(std::chrono::milliseconds(1));
  }
  if (WIFSIGNALED(status_)) {
    return fmt::format("was ended by signal {} ({})", WTERMSIG(status_),
                       strsignal(WTERMSIG(status_)));
  }
  return WEXITSTATUS(status_) == 0 ? std::string{}
                                   : fmt::format("ended with code {}", WEXITSTATUS(status_));
}

}  // namespace towbench::harness
