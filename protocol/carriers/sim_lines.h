// The machine's side of lines that the kernel simulates (gpio-sim): what is wired to the outside of
// the chip. The controller's side opens the same chip as any other (gpio_lines.h).
#pragma once

#include <array>
#include <memory>
#include <string>

#include "protocol/carriers/carrier_error.h"
#include "protocol/carriers/line_port.h"
#include "protocol/messages.h"

namespace towbench::protocol {

class SimLines final : public LinePort {
 public:
  // The nine lines of `chip` ("gpiochip0") from `first_line` on, in the order of gpio_lines.h.
  static CarrierResult<std::unique_ptr<SimLines>> open(const std::string& chip,
                                                       unsigned first_line);
  ~SimLines() override;

  // Levels only: the simulation keeps no times for its outside.
  core::Result<LineLevels> read() noexcept override;
  core::Status write(std::uint16_t lines) noexcept override;

 private:
  SimLines() = default;

  std::array<int, kWiredInputLines> pulls_{};  // file descriptors
  std::array<int, kWiredOutputLines> values_{};
  std::uint16_t written_ = 0;
  bool is_written_ = false;
};

}  // namespace towbench::protocol
