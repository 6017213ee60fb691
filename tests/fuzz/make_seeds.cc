// Writes the seeds of the protocol's fuzz targets: every message as its own file, and streams of
// many messages. Usage: make_fuzz_seeds CORPORA_DIR
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <string>
#include <vector>

#include "protocol/carriers/can_packer.h"
#include "protocol/cobs.h"
#include "protocol/frame.h"
#include "tests/protocol/any_message.h"
#include "tests/protocol/byte_sinks.h"
#include "tests/protocol/golden.h"

namespace towbench::protocol {
namespace {

namespace fs = std::filesystem;

void write_seed(const fs::path& directory, const std::string& name,
                const std::vector<std::byte>& bytes) {
  fs::create_directories(directory);
  std::ofstream file(directory / name, std::ios::binary);
  for (const std::byte byte : bytes) {
    file.put(static_cast<char>(byte));
  }
}

// The first byte of a stream seed chooses how the target cuts it into portions.
template <typename Writer>
void write_streams(const fs::path& directory) {
  for (const Golden& golden : golden_messages()) {
    KeepingByteSink out;
    Writer writer(out, FlushAt::kRequest);
    golden.send(writer);
    golden.send(writer);
    (void)writer.flush();
    out.bytes.insert(out.bytes.begin(), std::byte{7});
    write_seed(directory, golden.name, out.bytes);
  }
  for (std::uint64_t seed = 0; seed < 20; ++seed) {
    KeepingByteSink out;
    Writer writer(out, FlushAt::kRequest);
    AnyMessage any(seed);
    for (int i = 0; i < 5; ++i) {
      any.send_to(writer);
    }
    (void)writer.flush();
    out.bytes.insert(out.bytes.begin(), static_cast<std::byte>(seed * 13));
    write_seed(directory, "any" + std::to_string(seed), out.bytes);
  }
}

// Ten bytes a frame, as protocol_can_fuzz.cc reads them.
class FrameSeed final : public CanFrameSink {
 public:
  void on(const CanFrame& frame) noexcept override {
    // The targets' table of identifiers is in ascending order, two of each base.
    constexpr std::uint32_t kBases[] = {can_id::kFault,    can_id::kBye,   can_id::kLines,
                                        can_id::kDuty,     can_id::kIndex, can_id::kDigest,
                                        can_id::kLockstep, can_id::kLong,  can_id::kHeartbeat};
    for (std::size_t i = 0; i < std::size(kBases); ++i) {
      if ((frame.id & ~1U) == kBases[i]) {
        bytes.push_back(static_cast<std::byte>(2 * i + (frame.id & 1U)));
      }
    }
    bytes.push_back(std::byte{1});
    for (const std::uint8_t byte : frame.data) {
      bytes.push_back(static_cast<std::byte>(byte));
    }
  }
  std::vector<std::byte> bytes;
};

void write_can_seeds(const fs::path& directory) {
  for (std::uint64_t seed = 0; seed < 20; ++seed) {
    FrameSeed frames;
    CanPacker packer(seed % 2 == 0 ? CanDirection::kToPlant : CanDirection::kToController, frames);
    AnyMessage any(seed);
    for (int i = 0; i < 10; ++i) {
      any.send_to(packer);
    }
    EncoderReport report{.capture_period_ns = 1};
    for (; report.sequence < 6; ++report.sequence) {
      report.time_ns += core::kNanosecondsPerMillisecond;
      report.last_edge_ns = report.time_ns - 100;
      report.index_count += report.sequence == 4 ? 1 : 0;
      packer.on(report);
    }
    write_seed(directory, "any" + std::to_string(seed), frames.bytes);
  }
}

void write_all(const fs::path& corpora) {
  for (const Golden& golden : golden_messages()) {
    write_seed(corpora / "protocol_codec_fuzz", golden.name, bytes_of(golden.payload_hex));
  }
  write_streams<FrameWriter>(corpora / "protocol_frame_fuzz");
  write_can_seeds(corpora / "protocol_can_fuzz");
  write_streams<CobsWriter>(corpora / "protocol_cobs_fuzz");
}

}  // namespace
}  // namespace towbench::protocol

int main(int argc, char** argv) {
  if (argc != 2) {
    std::fputs("usage: make_fuzz_seeds CORPORA_DIR\n", stderr);
    return 2;
  }
  towbench::protocol::write_all(argv[1]);
  return 0;
}
