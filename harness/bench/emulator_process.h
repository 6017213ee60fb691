// A child process that runs the emulator for one experiment, joined by a pair of local sockets or
// met on a wire.
//
// The pair exists before the child does and nobody else holds its ends, so the death of either
// process at any moment ends the other's next read. On a wire the silence limit tells.
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
  // `program` is the towbench executable; `arguments` follow the verb `emulate`. All throw
  // std::system_error.
  [[nodiscard]] static std::unique_ptr<EmulatorProcess> with_socket(
      const std::filesystem::path& program, std::vector<std::string> arguments);
  // `address` is where the child waits.
  [[nodiscard]] static std::unique_ptr<EmulatorProcess> on_wire(
      const std::filesystem::path& program, std::vector<std::string> arguments,
      const std::string& address);
  EmulatorProcess(const EmulatorProcess&) = delete;
  EmulatorProcess& operator=(const EmulatorProcess&) = delete;
  // Waits for the child and, when it does not end by itself, ends it.
  ~EmulatorProcess();

  // The bench's end of the pair, once; null on a wire.
  [[nodiscard]] std::unique_ptr<protocol::LocalSocket> take_stream() noexcept {
    return std::move(stream_);
  }
  [[nodiscard]] pid_t id() const noexcept { return child_; }

  // Waits for the child; the stream must have been closed. "" when the child ended by itself with
  // 0, else a sentence.
  [[nodiscard]] std::string join();

 private:
  EmulatorProcess() = default;

  std::unique_ptr<protocol::LocalSocket> stream_;
  pid_t child_ = -1;
};

}  // namespace towbench::harness
