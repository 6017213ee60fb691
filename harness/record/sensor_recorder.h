// What the rig's sensors say, each at its own rate, in files of their own: force.csv of the force
// sensor, current_y.csv and current_x.csv of the amplifiers' current monitors, absolute_y.csv and
// its like of absolute encoders at the times of truth.csv, camera.csv of the camera, each frame
// with the time of its arrival. A sensor that is not fitted has no file.
#pragma once

#include <filesystem>
#include <optional>
#include <span>
#include <string_view>
#include <utility>

#include "emulator/rig_parameters.h"
#include "emulator/sensors/camera.h"
#include "harness/record/csv_writer.h"
#include "harness/record/row_blocks.h"
#include "protocol/messages.h"

namespace towbench::harness {

class SensorRecorder {
 public:
  // Creates the files. `writer` outlives this. Throws std::filesystem::filesystem_error.
  SensorRecorder(const std::filesystem::path& folder, const emulator::RigParameters& rig,
                 BackgroundWriter& writer);

  void add(const protocol::ForceSample& sample) noexcept;
  void add(const protocol::CurrentSample& sample) noexcept;
  void add(const emulator::CameraFrame& frame) noexcept;
  void add(const protocol::AbsoluteCount& count) noexcept;

  // Before the writer is waited for, and after.
  void hand_over() noexcept;
  void flush() noexcept;
  // As of the last flush().
  [[nodiscard]] bool good() const noexcept;

 private:
  struct WriteForce {
    CsvWriter* csv = nullptr;
    void operator()(std::span<const protocol::ForceSample> samples) const noexcept;
  };
  struct WriteCurrent {
    CsvWriter* csv = nullptr;
    void operator()(std::span<const protocol::CurrentSample> samples) const noexcept;
  };
  struct WriteAbsolute {
    CsvWriter* csv = nullptr;
    void operator()(std::span<const protocol::AbsoluteCount> counts) const noexcept;
  };
  struct WriteFrame {
    CsvWriter* csv = nullptr;
    core::PerAxis<bool> exists{};
    void operator()(std::span<const emulator::CameraFrame> frames) const noexcept;
  };
  template <typename Sample, typename Write>
  struct File {
    File(const std::filesystem::path& path, std::string_view header, BackgroundWriter& writer,
         Write write = {})
        : csv(path, header), rows(writer, with(std::move(write))) {}
    Write with(Write write) {
      write.csv = &csv;
      return write;
    }
    CsvWriter csv;
    RowBlocks<Sample, Write> rows;
  };

  std::optional<File<protocol::ForceSample, WriteForce>> force_;
  core::PerAxis<std::optional<File<protocol::CurrentSample, WriteCurrent>>> currents_;
  core::PerAxis<std::optional<File<protocol::AbsoluteCount, WriteAbsolute>>> absolutes_;
  std::optional<File<emulator::CameraFrame, WriteFrame>> camera_;
};

}  // namespace towbench::harness
