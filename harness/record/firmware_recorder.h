// The record of a controller on the virtual board: the files of record/controller_recorder.h, with
// log.csv from its telemetry where the image has some, else from its pins.
#pragma once

#include <filesystem>

#include "harness/checks/recorded_axes.h"
#include "harness/lockstep/bench_recorder.h"
#include "harness/lockstep/log_row.h"
#include "harness/record/csv_writer.h"
#include "harness/record/line_writer.h"
#include "harness/record/pin_row.h"

namespace towbench::harness {

class FirmwareRecorder final : public BenchRecorder {
 public:
  enum class Log : std::uint8_t { kTelemetry, kPins };
  FirmwareRecorder(const std::filesystem::path& folder, Log log,
                   const RecordedAxes& axes = planar_axes());

  void row(const LogRow& row) noexcept;
  void pins(const PinRow& row) noexcept { write_pin_row(log_, row); }
  void event(const bbmc::SystemEvent& event) noexcept;

  void drain(bbmc::ControllerNode& /*controller*/) noexcept override {}  // there is none
  void console(std::string_view text) noexcept override { console_.write(text); }
  void operator_acted(const OperatorAct& act) noexcept override;
  void wire_event(core::Nanoseconds time_ns, std::string_view kind) noexcept override;
  void timing(core::Nanoseconds time_ns, core::Nanoseconds host_ns,
              core::Nanoseconds exchange_ns) noexcept override;
  void flush() noexcept override;
  [[nodiscard]] std::uint64_t rows() const noexcept override { return log_.rows(); }
  [[nodiscard]] bool good() const noexcept override {
    return log_.good() && timing_.good() && events_.good() && console_.good();
  }

 private:
  RecordedAxes axes_;
  CsvWriter log_;
  CsvWriter timing_;
  LineWriter events_;
  LineWriter console_;
};

}  // namespace towbench::harness
