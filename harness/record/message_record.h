// What one side of a run heard, message by message, so that the run can be replayed from it.
//
// A file of frames (protocol/frame.h). What belongs to one turn stands before an Advance with the
// turn's end: for the plant a tick, for the controller an exchange.
//
//   plant_inputs.bin         written by the emulator's process
//   controller_inputs.bin
#pragma once

#include <filesystem>
#include <span>
#include <vector>

#include "harness/record/background_writer.h"
#include "harness/record/line_writer.h"
#include "harness/record/row_blocks.h"
#include "protocol/frame.h"
#include "protocol/stream_writer.h"

namespace towbench::harness {

inline constexpr const char* kPlantInputsFile = "plant_inputs.bin";
inline constexpr const char* kControllerInputsFile = "controller_inputs.bin";

class MessageRecord {
 public:
  // Creates the file. Throws std::filesystem::filesystem_error.
  explicit MessageRecord(const std::filesystem::path& path)
      : file_(path), bytes_(writer_, WriteBytes{&file_}) {}

  [[nodiscard]] protocol::MessageSink& sink() noexcept { return frames_; }

  void flush() noexcept;
  // As of the last flush().
  [[nodiscard]] bool good() const noexcept { return file_.good(); }

 private:
  struct WriteBytes {
    LineWriter* file = nullptr;
    void operator()(std::span<const std::byte> bytes) const noexcept;
  };
  // Copies into memory; the file is written by another thread, a block at a time.
  struct Bytes final : protocol::ByteSink {
    Bytes(BackgroundWriter& writer, WriteBytes write) : blocks(writer, write, kBlock_bytes) {}
    core::Status write(std::span<const std::byte> bytes) noexcept override;
    RowBlocks<std::byte, WriteBytes> blocks;
  };
  static constexpr std::size_t kBlock_bytes = std::size_t{1} << 16U;

  LineWriter file_;
  BackgroundWriter writer_;  // ends before what it writes to
  Bytes bytes_;
  protocol::FrameWriter frames_{bytes_, protocol::FlushAt::kRequest};
};

// Reads such a file again.
class MessageReplay {
 public:
  // Throws std::filesystem::filesystem_error when it cannot be read.
  explicit MessageReplay(const std::filesystem::path& path);

  // Delivers one turn but for its Advance, which is returned. False at the end of the file; what
  // was heard after the last whole turn has been delivered then.
  [[nodiscard]] bool play_turn(protocol::MessageSink& to, protocol::Advance& end);
  // Whether every byte so far belonged to a whole frame.
  [[nodiscard]] bool good() const noexcept { return reader_.counts().errors() == 0 && whole_; }

 private:
  std::vector<std::byte> bytes_;
  std::size_t at_ = 0;
  bool whole_ = true;
  protocol::FrameReader reader_;
};

}  // namespace towbench::harness
