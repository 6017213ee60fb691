// The controller's side of the record: log.csv, controller_events.jsonl, console.txt, timing.csv.
#pragma once

#include <filesystem>
#include <string_view>

#include "bbmc/host/controller_node.h"
#include "harness/record/csv_writer.h"
#include "harness/record/line_writer.h"
#include "harness/record/log_columns.h"
#include "harness/record/row_block.h"

namespace towbench::harness {

class ControllerRecorder {
 public:
  explicit ControllerRecorder(const std::filesystem::path& folder);
  ControllerRecorder(const ControllerRecorder&) = delete;
  ControllerRecorder& operator=(const ControllerRecorder&) = delete;
  ~ControllerRecorder();

  // Takes every row and event that waits in the controller.
  void drain(bbmc::ControllerNode& controller) noexcept;
  void console(std::string_view text) noexcept { console_.write(text); }
  void wire_event(core::Nanoseconds time_ns, std::string_view kind) noexcept;
  // `host_ns` since the start of the run.
  void timing(core::Nanoseconds time_ns, core::Nanoseconds host_ns,
              core::Nanoseconds exchange_ns) noexcept;

  void flush() noexcept;
  // Both as of the last flush().
  [[nodiscard]] std::uint64_t rows() const noexcept { return log_.rows(); }
  [[nodiscard]] bool good() const noexcept;

 private:
  struct WriteLog {
    CsvWriter* csv;
    void operator()(const bbmc::TelemetryRow& row) const noexcept { write_log_row(*csv, row); }
  };
  struct Timing {
    core::Nanoseconds time_ns = 0;
    core::Nanoseconds host_ns = 0;
    core::Nanoseconds exchange_ns = 0;
  };
  struct WriteTiming {
    CsvWriter* csv;
    void operator()(const Timing& timing) const noexcept;
  };

  CsvWriter log_;
  CsvWriter timing_;
  LineWriter events_;
  LineWriter console_;
  BackgroundWriter writer_;  // ends before what it writes to
  RowBlock<bbmc::TelemetryRow, WriteLog> log_rows_;
  RowBlock<Timing, WriteTiming> timing_rows_;
};

}  // namespace towbench::harness
