// Any bytes as a stream in length framing.
#include <cstdint>

#include "protocol/frame.h"
#include "tests/fuzz/stream_properties.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace towbench::protocol;
  check_reader<FrameReader>(std::as_bytes(std::span(data, size)));
  return 0;
}
