// The emulator's side of the record: truth.csv, what the sensors said (sensor_recorder.h) and
// plant_events.jsonl, written by whichever process runs the plant.
#pragma once

#include <filesystem>
#include <span>

#include "emulator/plant_node.h"
#include "harness/record/csv_writer.h"
#include "harness/record/line_writer.h"
#include "harness/record/log_columns.h"
#include "harness/record/row_blocks.h"
#include "harness/record/run_tap.h"
#include "harness/record/sensor_recorder.h"

namespace towbench::harness {

class PlantRecorder final : public emulator::PlantObserver {
 public:
  // `rig`: whose sensors are recorded. `tap` may be null; it outlives this.
  PlantRecorder(const std::filesystem::path& folder, const emulator::RigParameters& rig,
                RunTap* tap = nullptr);
  ~PlantRecorder() override;

  void on_truth(const emulator::TruthRow& row) noexcept override;
  void on_event(const emulator::PlantEvent& event) noexcept override;
  void on_force(const protocol::ForceSample& sample) noexcept override { sensors_.add(sample); }
  void on_frame(const emulator::CameraFrame& frame) noexcept override { sensors_.add(frame); }
  void on_current(const protocol::CurrentSample& sample) noexcept override { sensors_.add(sample); }

  void flush() noexcept;
  // Both as of the last flush().
  [[nodiscard]] std::uint64_t rows() const noexcept { return truth_.rows(); }
  [[nodiscard]] bool good() const noexcept {
    return truth_.good() && sensors_.good() && events_.good();
  }

 private:
  struct WriteTruth {
    CsvWriter* csv = nullptr;
    RecordedAxes axes;
    void operator()(std::span<const emulator::TruthRow> rows) const noexcept;
  };

  RunTap* tap_;
  CsvWriter truth_;
  LineWriter events_;
  BackgroundWriter writer_;  // ends before what it writes to
  RowBlocks<emulator::TruthRow, WriteTruth> rows_;
  SensorRecorder sensors_;  // its files outlive the last flush(), which waits for the writer
};

}  // namespace towbench::harness
