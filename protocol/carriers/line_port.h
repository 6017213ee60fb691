// The seam between the machine's digital lines and what they really are: GPIO lines, a test's bits.
//
// One bit a line, as in DigitalInputs (InputLine) and DigitalOutputs (OutputLine); 1 = active.
#pragma once

#include <cstdint>

#include "core/result.h"
#include "core/time.h"

namespace towbench::protocol {

struct LineLevels {
  std::uint16_t lines = 0;
  // Of the newest edge among those that led here, by the kernel's monotonic clock; 0 = none since
  // the lines were opened.
  core::Nanoseconds edge_ns = 0;
  std::uint32_t edges = 0;  // since the last call, bounces included
};

class LinePort {
 public:
  LinePort() = default;
  LinePort(const LinePort&) = delete;
  LinePort& operator=(const LinePort&) = delete;
  virtual ~LinePort() = default;

  // The lines that the other side drives, as they are now. Never waits. kTransportFailed when the
  // chip is gone.
  virtual core::Result<LineLevels> read() noexcept = 0;
  // The lines that this side drives.
  virtual core::Status write(std::uint16_t lines) noexcept = 0;
};

}  // namespace towbench::protocol
