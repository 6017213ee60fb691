// A child process that runs the emulator for one experiment, joined by a pair of local sockets.
//
// The stream exists before the child does and nobody else holds its ends, so the death of either
// process at any moment ends the other's next read.
#pragma once

#include <cstdint>
#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include <sys/types.h>

#include "protocol/carriers/local_socket.h"

namespace towbench::harness {

class EmulatorProcess {
 public:
  // `program` is the towbench executable; `arguments` follow the verb `emulate`. Throws
  // std::system_error.
  EmulatorProcess(const std::filesystem::path& program, std::vector<std::string> arguments);
  EmulatorProcess(const EmulatorProcess&) = delete;
  EmulatorProcess& operator=(const EmulatorProcess&) = delete;
  // Closes the stream, waits for the child and, when it does not end by itself, ends it.
  ~EmulatorProcess();

  [[nodiscard]] protocol::LocalSocket& stream() noexcept { return *stream_; }
  [[nodiscard]] pid_t id() const noexcept { return child_; }

  // Closes the stream and waits. "" when the child ended by itself with 0, else a sentence.
  [[nodiscard]] std::string join();

 private:
  std::unique_ptr<protocol::LocalSocket> stream_;
  pid_t child_ = -1;
};

}  // namespace towbench::harness
