// Any bytes: the C client takes and refuses what the bench's own codec does, and as a stream, in
// any portions, or as frames on a bus, they neither break it nor stop it.
#include <algorithm>
#include <cstdint>
#include <iterator>
#include <memory>

#include "clients/c/towbench.h"
#include "core/check.h"
#include "protocol/codec.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace towbench;
  static protocol::Decoder decoder;
  static const auto bench = std::make_unique<tb_bench>();
  protocol::MessageSink nobody;
  tb_init(bench.get(), TB_STREAM, 3, 1'000'000, TB_DIGEST);
  const bool taken = tb_take(bench.get(), data, size) != 0;
  core::check(taken == decoder.decode(std::as_bytes(std::span(data, size)), nobody).has_value());
  for (const tb_framing framing : {TB_STREAM, TB_COBS}) {
    tb_init(bench.get(), framing, 3, 1'000'000, TB_EDGES);
    const std::size_t step = size == 0 ? 1 : 1 + data[0];
    for (std::size_t at = 0; at < size;) {
      at += tb_feed(bench.get(), data + at, std::min(step, size - at));
    }
  }
  tb_init(bench.get(), TB_CAN, 3, 1'000'000, TB_DIGEST);
  static constexpr unsigned kHeard[] = {0x041, 0x051, 0x081, 0x180, 0x181, 0x190,
                                        0x191, 0x201, 0x601, 0x701, 0x7ff};
  for (std::size_t at = 0; at + 1 < size; at += 1 + TB_CAN_DATA) {
    tb_feed_frame(bench.get(), kHeard[data[at] % std::size(kHeard)], data + at + 1,
                  std::min<std::size_t>(TB_CAN_DATA, size - at - 1));
  }
  return 0;
}
