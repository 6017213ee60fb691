#include "protocol/cobs.h"

#include <algorithm>
#include <cstring>

namespace towbench::protocol {
namespace {

constexpr std::size_t kLongestRun = 254;  // bytes between two codes
constexpr std::byte kZero{0};

}  // namespace

std::size_t cobs_stuff(std::span<const std::byte> bytes, std::span<std::byte> into) noexcept {
  std::size_t code_at = 0;
  std::size_t out = 1;
  std::size_t run = 0;
  const auto close_run = [&]() noexcept {
    into[code_at] = static_cast<std::byte>(run + 1);
    code_at = out++;
    run = 0;
  };
  for (std::size_t i = 0; i < bytes.size(); ++i) {
    if (bytes[i] == kZero) {
      close_run();
      continue;
    }
    into[out++] = bytes[i];
    // A full run needs no code after it when the data ends with it.
    if (++run == kLongestRun && i + 1 < bytes.size()) {
      close_run();
    }
  }
  into[code_at] = static_cast<std::byte>(run + 1);
  return out;
}

std::size_t cobs_unstuff(std::span<std::byte> bytes) noexcept {
  std::size_t out = 0;
  std::size_t at = 0;
  while (at < bytes.size()) {
    const auto code = std::to_integer<std::size_t>(bytes[at++]);
    if (code == 0 || code - 1 > bytes.size() - at) {
      return 0;
    }
    std::memmove(bytes.data() + out, bytes.data() + at, code - 1);
    out += code - 1;
    at += code - 1;
    if (code <= kLongestRun && at < bytes.size()) {
      bytes[out++] = kZero;
    }
  }
  return out;
}

std::size_t CobsFraming::close(std::span<std::byte> body, std::size_t payload_size,
                               std::span<std::byte> into) noexcept {
  const std::size_t size = payload_size + kCrcSize;
  if (payload_size == 0 || size + cobs_overhead(size) + 1 > into.size()) {
    return 0;
  }
  store_little_endian(body.data() + payload_size, crc32c(body.first(payload_size)));
  const std::size_t stuffed = cobs_stuff(body.first(size), into);
  into[stuffed] = kZero;
  return stuffed + 1;
}

void CobsReader::feed(std::span<const std::byte> bytes, MessageSink& sink) noexcept {
  while (!bytes.empty()) {
    const auto* zero = static_cast<const std::byte*>(std::memchr(bytes.data(), 0, bytes.size()));
    if (zero == nullptr) {
      take(bytes);
      return;
    }
    const auto length = static_cast<std::size_t>(zero - bytes.data());
    take(bytes.first(length));
    close_frame(sink);
    bytes = bytes.subspan(length + 1);
  }
}

void CobsReader::take(std::span<const std::byte> bytes) noexcept {
  if (overflowed_ || bytes.size() > buffer_.size() - held_) {
    counts_.too_long += overflowed_ ? 0U : 1U;
    counts_.skipped_bytes += held_ + bytes.size();
    overflowed_ = true;
    held_ = 0;
    return;
  }
  if (!bytes.empty()) {
    std::memcpy(buffer_.data() + held_, bytes.data(), bytes.size());
    held_ += bytes.size();
  }
}

void CobsReader::close_frame(MessageSink& sink) noexcept {
  const std::size_t stuffed = held_;
  held_ = 0;
  if (overflowed_ || stuffed == 0) {  // two zeros in a row: an idle line, not an error
    overflowed_ = false;
    return;
  }
  const std::size_t size = cobs_unstuff(std::span(buffer_).first(stuffed));
  if (size <= kCrcSize) {
    ++counts_.malformed;
    counts_.skipped_bytes += stuffed;
    return;
  }
  const auto payload = std::span<const std::byte>(buffer_).first(size - kCrcSize);
  if (load_little_endian<std::uint32_t>(payload.data() + payload.size()) != crc32c(payload)) {
    ++counts_.bad_crc;
    counts_.skipped_bytes += stuffed;
    return;
  }
  const core::Status status = decoder_.decode(payload, sink);
  if (status.has_value()) {
    ++counts_.frames;
  } else if (status.error() == core::ErrorCode::kMessageUnknown) {
    ++counts_.unknown;
  } else {
    ++counts_.bad_field;
  }
}

void CobsReader::finish(MessageSink& /*sink*/) noexcept {
  counts_.truncated += held_ > 0 ? 1U : 0U;
  counts_.skipped_bytes += held_;
  held_ = 0;
  overflowed_ = false;
}

}  // namespace towbench::protocol
