// The controller's side of the record: log.csv, controller_events.jsonl, console.txt, timing.csv.
#pragma once

#include <filesystem>
#include <string_view>

#include "bbmc/host/controller_node.h"
#include "harness/record/csv_writer.h"
#include "harness/record/line_writer.h"

namespace towbench::harness {

class ControllerRecorder {
 public:
  explicit ControllerRecorder(const std::filesystem::path& folder);

  // Takes every row and event that waits in the controller.
  void drain(bbmc::ControllerNode& controller) noexcept;
  void console(std::string_view text) noexcept { console_.write(text); }
  void wire_event(core::Nanoseconds time_ns, std::string_view kind) noexcept;
  // `host_ns` since the start of the run.
  void timing(core::Nanoseconds time_ns, core::Nanoseconds host_ns,
              core::Nanoseconds exchange_ns) noexcept;

  void flush() noexcept;
  [[nodiscard]] std::uint64_t rows() const noexcept { return log_.rows(); }
  [[nodiscard]] bool good() const noexcept;

 private:
  CsvWriter log_;
  CsvWriter timing_;
  LineWriter events_;
  LineWriter console_;
};

}  // namespace towbench::harness
