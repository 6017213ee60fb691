// One digital line of a Linux board: on a GPIO chip (libgpiod 1.6, with edges timed by the kernel)
// or a file that holds 0 or 1 (linux_devices.h says how each is written).
#pragma once

#include <memory>
#include <string>

#include "bbmc/host/linux/device_trouble.h"
#include "core/result.h"
#include "core/time.h"

namespace towbench::bbmc {

struct LineEdge {
  core::Nanoseconds time_ns = 0;  // by the kernel's monotonic clock
  bool active = false;            // level after it
};

class LinuxLine {
 public:
  enum class Direction { kIn, kOut };

  // An output starts inactive. `trouble` outlives the line. The error is noted there.
  static core::Result<std::unique_ptr<LinuxLine>> open(const std::string& place,
                                                       const std::string& root, Direction direction,
                                                       DeviceTrouble& trouble);
  LinuxLine() = default;
  LinuxLine(const LinuxLine&) = delete;
  LinuxLine& operator=(const LinuxLine&) = delete;
  virtual ~LinuxLine() = default;

  [[nodiscard]] virtual core::Result<bool> level() noexcept = 0;
  [[nodiscard]] virtual core::Status drive(bool active) noexcept = 0;
  // The oldest edge that nobody has read; false when there is none. A file has none.
  [[nodiscard]] virtual core::Result<bool> next_edge(LineEdge& edge) noexcept = 0;
};

}  // namespace towbench::bbmc
