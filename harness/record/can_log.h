// candump.log of a run: every frame on the bus as the controller's end sees it, in the form of
// can-utils. Times are the run's own, from the Advance before a frame, so the file is the same from
// run to run and canplayer plays it at the pace of the machine.
#pragma once

#include <filesystem>
#include <string>

#include "core/time.h"
#include "harness/record/line_writer.h"
#include "protocol/carriers/can_frame.h"

namespace towbench::harness {

class CanLog final : public protocol::CanFrameSink {
 public:
  // Creates the file. Throws std::filesystem::filesystem_error.
  CanLog(const std::filesystem::path& path, std::string interface);

  void on(const protocol::CanFrame& frame) noexcept override;
  void flush() noexcept { lines_.flush(); }
  [[nodiscard]] bool good() const noexcept { return lines_.good(); }

 private:
  LineWriter lines_;
  std::string interface_;
  core::Nanoseconds now_ns_ = 0;
};

}  // namespace towbench::harness
