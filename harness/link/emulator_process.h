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

#include "harness/link/peer_control.h"
#include "protocol/carriers/local_socket.h"

namespace towbench::harness {

class EmulatorProcess final : public PeerControl {
 public:
  // `program` is the towbench executable; `arguments` follow the verb `emulate`; what a quiet one
  // has to say of its end is in its record only. All throw std::system_error.
  [[nodiscard]] static std::unique_ptr<EmulatorProcess> with_socket(
      const std::filesystem::path& program, std::vector<std::string> arguments, bool quiet = false);
  // `address` is where the child waits.
  [[nodiscard]] static std::unique_ptr<EmulatorProcess> on_wire(
      const std::filesystem::path& program, std::vector<std::string> arguments,
      const std::string& address, bool quiet = false);
  // Waits for the child and, when it does not end by itself, ends it.
  ~EmulatorProcess() override;

  // The bench's end of the pair, once; null on a wire.
  [[nodiscard]] std::unique_ptr<protocol::LocalSocket> take_stream() noexcept {
    return std::move(stream_);
  }
  [[nodiscard]] pid_t id() const noexcept { return child_; }

  // All for real: a signal that nobody can catch, a new process that keeps no record, an error
  // frame on the bus `address`.
  [[nodiscard]] core::ErrorCode kill_peer() noexcept override;
  [[nodiscard]] core::ErrorCode restart_peer() noexcept override;
  [[nodiscard]] core::ErrorCode leave_bus() noexcept override;

  // Waits for the child; the stream must have been closed. "" when the child ended by itself with
  // 0, else a sentence.
  [[nodiscard]] std::string join();

 private:
  EmulatorProcess() = default;

  void end_child() noexcept;

  std::unique_ptr<protocol::LocalSocket> stream_;
  std::filesystem::path program_;
  std::vector<std::string> again_;  // arguments of a new one that keeps no record
  std::string bus_;                 // interface; empty: not on a bus
  bool quiet_ = false;
  pid_t child_ = -1;
  bool struck_ = false;
  bool ends_by_itself_ = false;
};

}  // namespace towbench::harness
