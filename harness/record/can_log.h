// candump.log of a run: every frame on the bus as the controller's end sees it, in the form of
// can-utils. Times are the run's own: in lockstep from the Advance before a frame, so the file is
// the same from run to run and canplayer plays it at the pace of the machine; by the wall clock
// from the exchange in which the controller sent or took it.
#pragma once

#include <filesystem>
#include <string>

#include "core/time.h"
#include "harness/record/line_writer.h"
#include "protocol/carriers/can_frame.h"
#include "protocol/message_sink.h"

namespace towbench::harness {

class CanLog final : public protocol::CanFrameSink {
 public:
  // Creates the file. Throws std::filesystem::filesystem_error.
  CanLog(const std::filesystem::path& path, std::string interface);

  void on(const protocol::CanFrame& frame) noexcept override;
  // By the wall clock, where no Advance says it.
  void set_time(core::Nanoseconds now_ns) noexcept { now_ns_ = now_ns; }
  void flush() noexcept { lines_.flush(); }
  [[nodiscard]] bool good() const noexcept { return lines_.good(); }

 private:
  LineWriter lines_;
  std::string interface_;
  core::Nanoseconds now_ns_ = 0;
};

// Dates a log by the exchanges that a controller's witness is told of.
class CanLogClock final : public protocol::MessageSink {
 public:
  // `log` may be null and outlives this.
  explicit CanLogClock(CanLog* log) noexcept : log_(log) {}
  using MessageSink::on;
  void on(const protocol::Advance& advance) noexcept override {
    if (log_ != nullptr) {
      log_->set_time(advance.until_ns);
    }
  }

 private:
  CanLog* log_;
};

}  // namespace towbench::harness
