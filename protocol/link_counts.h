// What a stream reader met. Bad bytes are data: they are counted, and reading goes on.
#pragma once

#include <cstdint>

namespace towbench::protocol {

struct LinkCounts {
  std::uint64_t frames = 0;         // delivered to the sink
  std::uint64_t bad_crc = 0;        // a whole frame arrived with a wrong checksum
  std::uint64_t too_long = 0;       // a frame longer than any message
  std::uint64_t malformed = 0;      // bytes that are no frame: header, stuffing or length wrong
  std::uint64_t truncated = 0;      // the stream ended inside a frame
  std::uint64_t unknown = 0;        // checksum right, message id unknown
  std::uint64_t bad_field = 0;      // checksum right, a field out of range
  std::uint64_t skipped_bytes = 0;  // thrown away while looking for the next frame

  [[nodiscard]] constexpr std::uint64_t errors() const noexcept {
    return bad_crc + too_long + malformed + truncated + unknown + bad_field;
  }
  friend constexpr bool operator==(const LinkCounts&, const LinkCounts&) = default;
};

}  // namespace towbench::protocol
