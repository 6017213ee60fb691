// Any frames from a CAN bus: one byte chooses the identifier among ours, one the length, eight are
// data; those of an FD frame are repeated, counting up. What is delivered passed the codec's
// checks, and the same frames give the same messages.
#include <cstdint>
#include <cstring>
#include <memory>

#include "protocol/carriers/can_unpacker.h"
#include "tests/fuzz/stream_properties.h"

namespace towbench::protocol {
namespace {

constexpr std::uint32_t kIds[] = {can_id::kFault,     can_id::kFault + 1,    can_id::kBye,
                                  can_id::kBye + 1,   can_id::kLines,        can_id::kLines + 1,
                                  can_id::kDuty,      can_id::kDuty + 1,     can_id::kIndex,
                                  can_id::kIndex + 1, can_id::kDigest,       can_id::kDigest + 1,
                                  can_id::kLockstep,  can_id::kLockstep + 1, can_id::kLong,
                                  can_id::kLong + 1,  can_id::kHeartbeat,    can_id::kHeartbeat + 1,
                                  kMaxStandardId,     can_id::kEdges,        can_id::kEdges + 1};
constexpr std::size_t kInputPerFrame = 2 + kCanDataSize;

void unpack(std::span<const std::uint8_t> input, CanDirection direction) {
  const std::unique_ptr<CanUnpacker> unpacker(new CanUnpacker(direction));
  KeepPayloads sink;
  for (; input.size() >= kInputPerFrame; input = input.subspan(kInputPerFrame)) {
    CanFrame frame{.id = kIds[input[0] % std::size(kIds)],
                   .size = static_cast<std::uint8_t>(input[1] % 16 == 0 ? input[1] / 16 % 9 : 8)};
    std::memcpy(frame.data.data(), input.data() + 2, kCanDataSize);
    frame.is_fd = (frame.id & ~1U) == can_id::kEdges && input[1] % 16 != 1;
    if (frame.is_fd) {
      frame.size = static_cast<std::uint8_t>(can_fd_size(input[1] / 4U));
      for (std::size_t i = kCanDataSize; i < frame.size; ++i) {
        frame.data[i] = static_cast<std::uint8_t>(frame.data[i % kCanDataSize] + i);
      }
    }
    unpacker->take(frame, sink);
  }
  core::check(unpacker->counts().frames == sink.payloads.size());
}

}  // namespace
}  // namespace towbench::protocol

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace towbench::protocol;
  unpack({data, size}, CanDirection::kToPlant);
  unpack({data, size}, CanDirection::kToController);
  return 0;
}
