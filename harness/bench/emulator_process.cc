#include "harness/bench/emulator_process.h"

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

// Where the child finds its end of the stream.
constexpr int kStreamDescriptor = 3;
constexpr auto kPatience = std::chrono::milliseconds(2000);

void check(int error, const char* what) {
  if (error != 0) {
    throw std::system_error(error, std::generic_category(), what);
  }
}

// `stream` < 0: the child inherits none.
pid_t spawn(const std::filesystem::path& program, std::vector<std::string> arguments, int stream) {
  arguments.insert(arguments.begin(), {program.string(), "emulate"});
  std::vector<char*> argv;
  argv.reserve(arguments.size() + 1);
  for (auto& argument : arguments) {
    argv.push_back(argument.data());
  }
  argv.push_back(nullptr);

  posix_spawn_file_actions_t actions{};
  posix_spawnattr_t attributes{};
  check(posix_spawn_file_actions_init(&actions), "posix_spawn_file_actions_init");
  check(posix_spawnattr_init(&attributes), "posix_spawnattr_init");
  posix_spawn_file_actions_addopen(&actions, STDIN_FILENO, "/dev/null", O_RDONLY, 0);
  if (stream >= 0) {
    posix_spawn_file_actions_adddup2(&actions, stream, kStreamDescriptor);
  }
  // A group of its own: Ctrl-C is for the parent, which then says Bye.
  posix_spawnattr_setflags(&attributes, POSIX_SPAWN_SETPGROUP);
  pid_t child = -1;
  const int error =
      posix_spawn(&child, program.c_str(), &actions, &attributes, argv.data(), environ);
  posix_spawn_file_actions_destroy(&actions);
  posix_spawnattr_destroy(&attributes);
  check(error, "cannot start the emulator's process");
  return child;
}

std::string sentence_about(int status) {
  if (WIFSIGNALED(status)) {
    return fmt::format("the emulator's process was ended by signal {} ({})", WTERMSIG(status),
                       strsignal(WTERMSIG(status)));
  }
  return WEXITSTATUS(status) == 0
             ? std::string{}
             : fmt::format("the emulator's process ended with code {}", WEXITSTATUS(status));
}

}  // namespace

std::unique_ptr<EmulatorProcess> EmulatorProcess::with_socket(const std::filesystem::path& program,
                                                              std::vector<std::string> arguments) {
  auto ends = protocol::LocalSocket::pair();
  if (!ends) {
    throw std::system_error(std::make_error_code(std::errc::io_error), ends.error().message);
  }
  arguments.insert(arguments.end(), {"--stream-descriptor", std::to_string(kStreamDescriptor)});
  std::unique_ptr<EmulatorProcess> process(new EmulatorProcess);
  process->stream_ = std::move(ends->first);
  process->child_ = spawn(program, std::move(arguments), ends->second->descriptor());
  return process;
}

std::unique_ptr<EmulatorProcess> EmulatorProcess::on_wire(const std::filesystem::path& program,
                                                          std::vector<std::string> arguments,
                                                          const std::string& address) {
  // An orphan that nobody greets must not hold the wire for ever.
  arguments.insert(arguments.end(), {"--carrier", address, "--patience", "10"});
  std::unique_ptr<EmulatorProcess> process(new EmulatorProcess);
  process->child_ = spawn(program, std::move(arguments), -1);
  return process;
}

EmulatorProcess::~EmulatorProcess() {
  (void)join();
}

std::string EmulatorProcess::join() {
  if (child_ < 0) {
    return {};
  }
  stream_.reset();
  int status = 0;
  const auto deadline = std::chrono::steady_clock::now() + kPatience;
  while (waitpid(child_, &status, WNOHANG) == 0) {
    if (std::chrono::steady_clock::now() > deadline) {
      kill(child_, SIGKILL);
      waitpid(child_, &status, 0);
      break;
    }
    std::this_thread::sleep_for(std::chrono::milliseconds(1));
  }
  child_ = -1;
  return sentence_about(status);
}

}  // namespace towbench::harness
