// A debugger's view of the bench's own BBMC on the virtual board (bbmc/baremetal/debug_port.h): its
// parameters before the start, its telemetry while it runs. An image that has no such port is a
// third-party image: nothing is known of it but its pins and its console.
#pragma once

#include <cstdint>
#include <optional>
#include <string>

#include "bbmc/baremetal/debug_port.h"
#include "bbmc/system/configuration.h"
#include "board/board.h"

namespace towbench::harness {

class DebugProbe {
 public:
  // The board outlives this and has its image.
  explicit DebugProbe(board::Board& board);

  [[nodiscard]] bool has_port() const noexcept { return port_ != nullptr; }
  // Writes the controller's parameters into the image. Empty, or why that cannot be.
  [[nodiscard]] std::string set_parameters(const bbmc::Configuration& configuration);

  // False when none waits.
  [[nodiscard]] bool next_row(bbmc::TelemetryRow& row) noexcept;
  [[nodiscard]] bool next_event(bbmc::SystemEvent& event) noexcept;
  [[nodiscard]] bool idle() const noexcept { return port_->idle != 0; }
  [[nodiscard]] std::uint64_t rows_lost() const noexcept {
    return port_ == nullptr ? 0 : port_->lost;
  }
  // Deepest use of the stack, in bytes: of the bench's own image by its paint, of a third-party
  // image by the zeros below it. None where the stack of a third-party image lies among its other
  // data.
  [[nodiscard]] std::optional<std::uint32_t> stack_used() const;
  // 0 where the image has no such symbols.
  [[nodiscard]] std::uint32_t stack_size() const;

 private:
  [[nodiscard]] bool is_running() const noexcept {
    return port_ != nullptr && port_->magic == bbmc::DebugPort::kMagic;
  }

  [[nodiscard]] std::optional<std::uint32_t> stack_of_third_party() const;

  board::Board& board_;
  bbmc::DebugPort* port_ = nullptr;
};

}  // namespace towbench::harness
