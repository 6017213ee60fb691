#include "harness/link/emulator_process.h"

#include <algorithm>
#include <chrono>
#include <csignal>
#include <cstring>
#include <string_view>
#include <system_error>
#include <thread>

#include <fcntl.h>
#include <fmt/format.h>
#include <linux/can.h>
#include <linux/can/error.h>
#include <linux/can/raw.h>
#include <net/if.h>
#include <spawn.h>
#include <sys/socket.h>
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
pid_t spawn(const std::filesystem::path& program, std::vector<std::string> arguments, int stream,
            bool quiet) {
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
  if (quiet) {
    posix_spawn_file_actions_addopen(&actions, STDERR_FILENO, "/dev/null", O_WRONLY, 0);
  }
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

std::vector<std::string> without_record(std::vector<std::string> arguments) {
  if (const auto out = std::find(arguments.begin(), arguments.end(), "--out");
      out != arguments.end()) {
    arguments.erase(out, out + 2);
  }
  return arguments;
}

// As a driver tells every node of the interface that its controller has left the bus.
bool send_bus_off(const std::string& interface) noexcept {
  const int bus = socket(PF_CAN, SOCK_RAW | SOCK_CLOEXEC, CAN_RAW);
  sockaddr_can address{};
  address.can_family = AF_CAN;
  address.can_ifindex = static_cast<int>(if_nametoindex(interface.c_str()));
  can_frame frame{};
  frame.can_id = CAN_ERR_FLAG | CAN_ERR_BUSOFF;
  frame.can_dlc = CAN_ERR_DLC;
  const bool sent = bus >= 0 && address.can_ifindex > 0 &&
                    // NOLINTNEXTLINE: the socket interface's own way
                    bind(bus, reinterpret_cast<const sockaddr*>(&address), sizeof address) == 0 &&
                    write(bus, &frame, sizeof frame) == sizeof frame;
  close(bus);
  return sent;
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
                                                              std::vector<std::string> arguments,
                                                              bool quiet) {
  auto ends = protocol::LocalSocket::pair();
  if (!ends) {
    throw std::system_error(std::make_error_code(std::errc::io_error), ends.error().message);
  }
  arguments.insert(arguments.end(), {"--stream-descriptor", std::to_string(kStreamDescriptor)});
  std::unique_ptr<EmulatorProcess> process(new EmulatorProcess);
  process->stream_ = std::move(ends->first);
  process->child_ = spawn(program, std::move(arguments), ends->second->descriptor(), quiet);
  return process;
}

std::unique_ptr<EmulatorProcess> EmulatorProcess::on_wire(const std::filesystem::path& program,
                                                          std::vector<std::string> arguments,
                                                          const std::string& address, bool quiet) {
  // An orphan that nobody greets must not hold the wire for ever.
  arguments.insert(arguments.end(), {"--carrier", address, "--patience", "10"});
  std::unique_ptr<EmulatorProcess> process(new EmulatorProcess);
  process->program_ = program;
  process->quiet_ = quiet;
  process->again_ = without_record(arguments);
  constexpr std::string_view kCan = "can:";
  process->bus_ =
      address.starts_with(kCan) ? address.substr(kCan.size(), address.find('@') - kCan.size()) : "";
  process->child_ = spawn(program, std::move(arguments), -1, quiet);
  return process;
}

EmulatorProcess::~EmulatorProcess() {
  (void)join();
}

void EmulatorProcess::end_child() noexcept {
  if (child_ > 0) {
    kill(child_, SIGKILL);
    waitpid(child_, nullptr, 0);
    child_ = -1;
  }
}

core::ErrorCode EmulatorProcess::kill_peer() noexcept {
  struck_ = true;
  end_child();
  return core::ErrorCode::kNone;
}

core::ErrorCode EmulatorProcess::restart_peer() noexcept {
  struck_ = true;
  end_child();
  try {
    child_ = spawn(program_, again_, -1, quiet_);
  } catch (const std::exception&) {
    return core::ErrorCode::kTransportFailed;  // gone for good is lost too
  }
  return core::ErrorCode::kNone;
}

core::ErrorCode EmulatorProcess::leave_bus() noexcept {
  struck_ = true;
  ends_by_itself_ = true;  // its own driver tells it
  return send_bus_off(bus_) ? core::ErrorCode::kNone : core::ErrorCode::kTransportFailed;
}

std::string EmulatorProcess::join() {
  if (child_ < 0) {
    return {};
  }
  stream_.reset();
  if (struck_ && !ends_by_itself_) {  // it waits for a peer that has ended
    end_child();
    return {};
  }
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
  return struck_ ? std::string{} : sentence_about(status);
}

}  // namespace towbench::harness
