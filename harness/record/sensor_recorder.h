// What the rig's sensors say, each at its own rate, in files of their own: force.csv of the force
// sensor, current_y.csv and current_x.csv of the amplifiers' current monitors. A sensor that is not
// fitted has no file.
#pragma once

#include <filesystem>
#include <optional>
#include <span>
#include <string_view>

#include "emulator/rig_parameters.h"
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
  template <typename Sample, typename Write>
  struct File {
    File(const std::filesystem::path& path, std::string_view header, BackgroundWriter& writer)
        : csv(path, header), rows(writer, Write{&csv}) {}
    CsvWriter csv;
    RowBlocks<Sample, Write> rows;
  };

  std::optional<File<protocol::ForceSample, WriteForce>> force_;
  core::PerAxis<std::optional<File<protocol::CurrentSample, WriteCurrent>>> currents_;
};

}  // namespace towbench::harness
