// The controller's side of the record: log.csv, controller_events.jsonl, console.txt, timing.csv.
#pragma once

#include <filesystem>
#include <span>
#include <string_view>

#include "bbmc/host/controller_node.h"
#include "bbmc/host/linux/linux_node.h"
#include "harness/lockstep/bench_recorder.h"
#include "harness/record/csv_writer.h"
#include "harness/record/line_writer.h"
#include "harness/record/log_columns.h"
#include "harness/record/row_blocks.h"
#include "harness/record/run_tap.h"

namespace towbench::harness {

class ControllerRecorder final : public BenchRecorder {
 public:
  // `tap` may be null; it outlives this.
  explicit ControllerRecorder(const std::filesystem::path& folder, RunTap* tap = nullptr);
  ~ControllerRecorder() override;

  void drain(bbmc::ControllerNode& controller) noexcept override;
  void drain(bbmc::LinuxNode& controller) noexcept;
  void console(std::string_view text) noexcept override;
  void operator_acted(const OperatorAct& act) noexcept override;
  void wire_event(core::Nanoseconds time_ns, std::string_view kind) noexcept override;
  void timing(core::Nanoseconds time_ns, core::Nanoseconds host_ns,
              core::Nanoseconds exchange_ns) noexcept override;

  // What was handed to the writer's thread is written; what waits to be handed over still waits. In
  // lockstep the machine's seconds pass while that thread waits for a core: a moment of the
  // machine's time is one of the record's only after this.
  void catch_up() noexcept { writer_.wait(); }
  void flush() noexcept override;
  [[nodiscard]] std::uint64_t rows() const noexcept override { return log_.rows(); }
  [[nodiscard]] bool good() const noexcept override;

 private:
  template <typename Controller>
  void take_all(Controller& controller) noexcept;

  struct WriteLog {
    CsvWriter* csv = nullptr;
    void operator()(std::span<const bbmc::TelemetryRow> rows) const noexcept;
  };
  struct Timing {
    core::Nanoseconds time_ns = 0;
    core::Nanoseconds host_ns = 0;
    core::Nanoseconds exchange_ns = 0;
  };
  struct WriteTiming {
    CsvWriter* csv = nullptr;
    void operator()(std::span<const Timing> rows) const noexcept;
  };

  void event(const std::string& line) noexcept;

  RunTap* tap_;
  CsvWriter log_;
  CsvWriter timing_;
  LineWriter events_;
  LineWriter console_;
  BackgroundWriter writer_;  // ends before what it writes to
  RowBlocks<bbmc::TelemetryRow, WriteLog> log_rows_;
  RowBlocks<Timing, WriteTiming> timing_rows_;
};

}  // namespace towbench::harness
