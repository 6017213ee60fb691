#include "protocol/frame.h"

#include <algorithm>
#include <cstring>

namespace towbench::protocol {

void FrameReader::feed(std::span<const std::byte> bytes, MessageSink& sink) noexcept {
  // The common case: nothing held back, whole frames, no copy.
  if (held_ == 0) {
    bytes = bytes.subspan(consume(bytes, sink));
  }
  while (!bytes.empty()) {
    const std::size_t taken = std::min(bytes.size(), buffer_.size() - held_);
    std::memcpy(buffer_.data() + held_, bytes.data(), taken);
    held_ += taken;
    bytes = bytes.subspan(taken);
    const std::size_t done = consume({buffer_.data(), held_}, sink);
    held_ -= done;
    std::memmove(buffer_.data(), buffer_.data() + done, held_);
  }
}

std::size_t FrameReader::consume(std::span<const std::byte> bytes, MessageSink& sink) noexcept {
  std::size_t at = 0;
  while (bytes.size() - at > kFrameHeaderSize) {
    const auto size = load_little_endian<std::uint16_t>(bytes.data() + at);
    const std::size_t covered = kFrameHeaderSize + size;
    if (size > kMaxPayloadSize || !is_plausible(bytes[at + kFrameHeaderSize], size)) {
      lose_place(size > kMaxPayloadSize ? counts_.too_long : counts_.malformed);
      ++at;
      continue;
    }
    if (bytes.size() - at < covered + kCrcSize) {
      break;
    }
    const auto crc = load_little_endian<std::uint32_t>(bytes.data() + at + covered);
    if (crc != crc32c(bytes.subspan(at, covered))) {
      lose_place(counts_.bad_crc);
      ++at;
      continue;
    }
    in_place_ = true;
    deliver(bytes.subspan(at + kFrameHeaderSize, size), sink);
    at += covered + kCrcSize;
  }
  return at;
}

void FrameReader::deliver(std::span<const std::byte> payload, MessageSink& sink) noexcept {
  if (decoder_.decode(payload, sink).has_value()) {
    ++counts_.frames;
  } else {
    ++counts_.bad_field;
  }
}

// One loss of place is one error, however many bytes it takes to find the next frame.
void FrameReader::lose_place(std::uint64_t& reason) noexcept {
  reason += in_place_ ? 1U : 0U;
  in_place_ = false;
  ++counts_.skipped_bytes;
}

void FrameReader::finish(MessageSink& sink) noexcept {
  std::size_t at = 0;
  while (at < held_) {
    lose_place(counts_.truncated);
    ++at;
    at += consume(std::span<const std::byte>(buffer_).first(held_).subspan(at), sink);
  }
  held_ = 0;
}

}  // namespace towbench::protocol
