// Any bytes: the C client takes and refuses what the bench's own codec does, and as a stream, in
// any portions, they neither break it nor stop it.
#include <algorithm>
#include <cstdint>
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
  return 0;
}
