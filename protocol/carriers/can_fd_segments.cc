#include "protocol/carriers/can_fd_segments.h"

#include <algorithm>

#include "protocol/wire.h"

namespace towbench::protocol {
namespace {

constexpr std::uint8_t kFirstFdSegment = 0x80;
constexpr std::size_t kLengthSize = 2;

}  // namespace

bool send_fd_segmented(std::span<const std::byte> payload, std::uint32_t id,
                       CanFrameSink& out) noexcept {
  if (payload.empty() || payload.size() > kMaxPayloadSize) {
    return false;
  }
  std::array<std::byte, fd_segments_of(kMaxPayloadSize) * kCanFdSegmentSize> bytes;
  const std::size_t segments = fd_segments_of(payload.size());
  const std::size_t covered = kLengthSize + payload.size();
  store_little_endian(bytes.data(), static_cast<std::uint16_t>(payload.size()));
  std::copy(payload.begin(), payload.end(), bytes.begin() + kLengthSize);
  store_little_endian(bytes.data() + covered, crc32c(std::span(bytes).first(covered)));
  std::fill(bytes.data() + covered + kCrcSize, bytes.data() + segments * kCanFdSegmentSize,
            std::byte{0});

  for (std::size_t i = 0; i < segments; ++i) {
    const bool is_last = i + 1 == segments;
    CanFrame frame{.id = id, .is_fd = true};
    frame.size =
        static_cast<std::uint8_t>(is_last ? last_fd_segment_of(payload.size()) : kCanFdDataSize);
    frame.data[0] = static_cast<std::uint8_t>((i == 0 ? kFirstFdSegment : 0U) | (segments - 1 - i));
    for (std::size_t j = 1; j < frame.size; ++j) {
      frame.data[j] = std::to_integer<std::uint8_t>(bytes[i * kCanFdSegmentSize + j - 1]);
    }
    out.on(frame);
  }
  return true;
}

std::span<const std::byte> CanFdReassembler::take(const CanFrame& frame,
                                                  LinkCounts& counts) noexcept {
  const bool is_first = frame.size > 0 && (frame.data[0] & kFirstFdSegment) != 0;
  const std::size_t following = frame.data[0] & ~unsigned{kFirstFdSegment};
  const bool is_next = following_ > 0 && following + 1 == following_;
  // A new message cuts the one before off; anything else that is not next has no place.
  if (is_first) {
    counts.truncated += following_ > 0 ? 1U : 0U;
    held_ = 0;
  }
  const bool is_sized = following == 0 ? frame.size > 0 : frame.size == kCanFdDataSize;
  if (!is_sized || (!is_first && !is_next) ||
      held_ + (following + 1) * kCanFdSegmentSize > bytes_.size()) {
    ++counts.malformed;
    counts.skipped_bytes += frame.size;
    following_ = 0;
    return {};
  }
  for (std::size_t j = 1; j < frame.size; ++j) {
    bytes_[held_++] = static_cast<std::byte>(frame.data[j]);
  }
  following_ = following;
  return following_ > 0 ? std::span<const std::byte>() : whole(counts);
}

std::span<const std::byte> CanFdReassembler::whole(LinkCounts& counts) const noexcept {
  const auto size = held_ < kLengthSize
                        ? std::size_t{0}
                        : std::size_t{load_little_endian<std::uint16_t>(bytes_.data())};
  const std::size_t expected =
      (fd_segments_of(size) - 1) * kCanFdSegmentSize + last_fd_segment_of(size) - 1;
  if (size == 0 || held_ != expected) {
    ++counts.malformed;
    return {};
  }
  const std::size_t covered = kLengthSize + size;
  const auto crc = load_little_endian<std::uint32_t>(bytes_.data() + covered);
  if (crc != crc32c(std::span<const std::byte>(bytes_).first(covered))) {
    ++counts.bad_crc;
    return {};
  }
  return std::span<const std::byte>(bytes_).subspan(kLengthSize, size);
}

}  // namespace towbench::protocol
