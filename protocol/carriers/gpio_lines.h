// End-stops, kill switch and amplifier enable on real GPIO lines (libgpiod 1.6; its calls stand in
// gpio_lines.cc and nowhere else).
//
// On one chip, from an offset on: seven lines from the machine in the order of InputLine, then two
// to it in the order of OutputLine. The controller's side reads the seven and drives the two; the
// plant's side the other way round. Edges are read from the kernel's event queue with its own time
// stamps. Each line counts as changed once it has kept its level for `debounce_ns`.
#pragma once

#include <cstdint>
#include <memory>
#include <string>

#include "protocol/carriers/carrier_error.h"
#include "protocol/carriers/line_debouncer.h"
#include "protocol/carriers/line_port.h"

namespace towbench::protocol {

enum class LineSide : std::uint8_t { kController, kPlant };

struct GpioPlace {
  std::string chip;         // "gpiochip0" or a path
  unsigned first_line = 0;  // the chip's number of the first of the nine
  core::Nanoseconds debounce_ns = 0;
};

class GpioLines final : public LinePort {
 public:
  // What this side drives starts inactive. Refused in words that name the chip, and the line and
  // its holder when another process has it: no such chip, too few lines, a line that is taken.
  static CarrierResult<std::unique_ptr<GpioLines>> open(const GpioPlace& place, LineSide side);
  ~GpioLines() override;  // what it drives goes inactive

  core::Result<LineLevels> read() noexcept override;
  core::Status write(std::uint16_t lines) noexcept override;

 private:
  class Chip;
  GpioLines(std::unique_ptr<Chip> chip, LineDebouncer debouncer) noexcept;

  std::unique_ptr<Chip> chip_;
  LineDebouncer debouncer_;
  LineLevels seen_;
};

}  // namespace towbench::protocol
