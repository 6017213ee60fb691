#include "protocol/carriers/can_segments.h"

#include <algorithm>

#include "protocol/wire.h"

namespace towbench::protocol {
namespace {

constexpr std::uint8_t kFirstSegment = 0x80;

}  // namespace

bool send_segmented(std::span<const std::byte> payload, std::uint32_t id,
                    CanFrameSink& out) noexcept {
  if (payload.empty() || payload.size() > kMaxSegmentedPayload) {
    return false;
  }
  std::array<std::byte, segments_of(kMaxSegmentedPayload) * kCanSegmentSize> bytes{};
  const std::size_t covered = 1 + payload.size();
  bytes[0] = static_cast<std::byte>(payload.size());
  std::copy(payload.begin(), payload.end(), bytes.begin() + 1);
  store_little_endian(bytes.data() + covered, crc32c(std::span(bytes).first(covered)));

  const std::size_t segments = segments_of(payload.size());
  for (std::size_t i = 0; i < segments; ++i) {
    CanFrame frame{.id = id, .size = kCanDataSize};
    frame.data[0] = static_cast<std::uint8_t>((i == 0 ? kFirstSegment : 0U) | (segments - 1 - i));
    for (std::size_t j = 0; j < kCanSegmentSize; ++j) {
      frame.data[1 + j] = std::to_integer<std::uint8_t>(bytes[i * kCanSegmentSize + j]);
    }
    out.on(frame);
  }
  return true;
}

std::span<const std::byte> CanReassembler::take(const CanFrame& frame,
                                                LinkCounts& counts) noexcept {
  const bool is_first = frame.size > 0 && (frame.data[0] & kFirstSegment) != 0;
  const std::size_t following = frame.data[0] & ~unsigned{kFirstSegment};
  const bool is_next = following_ > 0 && following + 1 == following_;
  // A new message cuts the one before off; anything else that is not next has no place.
  if (is_first) {
    counts.truncated += following_ > 0 ? 1U : 0U;
    held_ = 0;
  }
  if (frame.size != kCanDataSize || (!is_first && !is_next) ||
      held_ + (following + 1) * kCanSegmentSize > bytes_.size()) {
    ++counts.malformed;
    counts.skipped_bytes += frame.size;
    following_ = 0;
    return {};
  }
  for (std::size_t j = 0; j < kCanSegmentSize; ++j) {
    bytes_[held_++] = static_cast<std::byte>(frame.data[1 + j]);
  }
  following_ = following;
  if (following_ > 0) {
    return {};
  }
  const auto size = std::to_integer<std::size_t>(bytes_[0]);
  const std::size_t covered = 1 + size;
  if (held_ != segments_of(size) * kCanSegmentSize) {
    ++counts.malformed;
    return {};
  }
  const auto crc = load_little_endian<std::uint32_t>(bytes_.data() + covered);
  if (crc != crc32c(std::span<const std::byte>(bytes_).first(covered))) {
    ++counts.bad_crc;
    return {};
  }
  return std::span<const std::byte>(bytes_).subspan(1, size);
}

}  // namespace towbench::protocol
