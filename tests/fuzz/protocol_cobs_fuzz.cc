// Any bytes as a stream in COBS framing, and any bytes through stuffing and back.
#include <algorithm>
#include <cstdint>

#include "protocol/cobs.h"
#include "tests/fuzz/stream_properties.h"

namespace towbench::protocol {
namespace {

void check_stuffing(std::span<const std::byte> bytes) {
  std::vector<std::byte> stuffed(bytes.size() + cobs_overhead(bytes.size()));
  stuffed.resize(cobs_stuff(bytes, stuffed));
  core::check(std::find(stuffed.begin(), stuffed.end(), std::byte{0}) == stuffed.end());
  stuffed.resize(cobs_unstuff(stuffed));
  core::check(std::equal(stuffed.begin(), stuffed.end(), bytes.begin(), bytes.end()));
}

}  // namespace
}  // namespace towbench::protocol

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace towbench::protocol;
  const auto bytes = std::as_bytes(std::span(data, size));
  check_stuffing(bytes);
  check_reader<CobsReader>(bytes);
  return 0;
}
