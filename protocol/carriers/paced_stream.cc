#include "protocol/carriers/paced_stream.h"

#include <algorithm>
#include <chrono>
#include <thread>

namespace towbench::protocol {

core::Nanoseconds HostWireClock::now_ns() noexcept {
  return std::chrono::nanoseconds(std::chrono::steady_clock::now().time_since_epoch()).count();
}

void HostWireClock::wait_until(core::Nanoseconds time_ns) noexcept {
  std::this_thread::sleep_until(
      std::chrono::steady_clock::time_point(std::chrono::nanoseconds(time_ns)));
}

core::Nanoseconds WirePacer::reserve(core::Nanoseconds now_ns, std::uint64_t bits) noexcept {
  if (now_ns > busy_until_ns_) {
    busy_until_ns_ = now_ns;
    rest_ = 0;
  }
  const std::uint64_t scaled = bits * std::uint64_t{core::kNanosecondsPerSecond} + rest_;
  busy_until_ns_ += static_cast<core::Nanoseconds>(scaled / bits_per_second_);
  rest_ = scaled % bits_per_second_;
  return busy_until_ns_;
}

core::Result<std::size_t> PacedStream::read_some(std::span<std::byte> into,
                                                 core::Nanoseconds timeout_ns) noexcept {
  const core::Nanoseconds start_ns = clock_.now_ns();
  const core::Nanoseconds deadline_ns = start_ns + std::max<core::Nanoseconds>(timeout_ns, 0);
  // What has come must be noticed now, or it would be dated later than it is.
  if (const auto status = take_in(held_ == 0 ? timeout_ns : 0); !status) {
    return core::failure(status.error());
  }
  if (held_ > 0) {
    const core::Nanoseconds due_ns = under_way_[first_].arrival_ns;
    if (due_ns > clock_.now_ns()) {
      clock_.wait_until(std::min(due_ns, deadline_ns));
    }
  }
  return hand_out(into);
}

core::Status PacedStream::take_in(core::Nanoseconds timeout_ns) noexcept {
  if (held_ == kCapacity) {
    return {};
  }
  if (ended_.has_value()) {
    const auto size = line_.read_some(std::span(received_).first(kCapacity - held_), timeout_ns);
    const core::Nanoseconds now_ns = clock_.now_ns();
    for (std::size_t i = 0; size && i < *size; ++i) {
      under_way_[(first_ + held_++) % kCapacity] = {received_[i],
                                                    pacer_.reserve(now_ns, bits_per_byte_)};
    }
    ended_ = size ? core::Status() : core::failure(size.error());
  }
  // The end of the line comes after the bytes that are under way.
  return held_ > 0 ? core::Status() : ended_;
}

std::size_t PacedStream::hand_out(std::span<std::byte> into) noexcept {
  const core::Nanoseconds now_ns = clock_.now_ns();
  std::size_t size = 0;
  while (held_ > 0 && size < into.size() && under_way_[first_].arrival_ns <= now_ns) {
    into[size++] = under_way_[first_].byte;
    first_ = (first_ + 1) % kCapacity;
    --held_;
  }
  return size;
}

}  // namespace towbench::protocol
