#include "protocol/carriers/paced_can.h"

#include <algorithm>
#include <charconv>
#include <system_error>

namespace towbench::protocol {
namespace {

bool read_rate(std::string_view text, std::uint32_t& bit_per_s) noexcept {
  const char* const end = text.data() + text.size();
  const auto number = std::from_chars(text.data(), end, bit_per_s);
  return number.ec == std::errc() && number.ptr == end && bit_per_s > 0;
}

}  // namespace

std::optional<NamedBus> named_bus(std::string_view place) {
  const auto at = place.rfind('@');
  NamedBus bus{.interface = std::string(place.substr(0, at))};
  if (at == std::string_view::npos) {
    return bus;
  }
  const auto rates = place.substr(at + 1);
  if (rates == "fd") {
    bus.is_fd = true;
    return bus;
  }
  const auto slash = rates.find('/');
  bus.is_fd = slash != std::string_view::npos;
  const bool are_rates = read_rate(rates.substr(0, slash), bus.bit_per_s) &&
                         (!bus.is_fd || read_rate(rates.substr(slash + 1), bus.data_bit_per_s));
  return are_rates ? std::optional(bus) : std::nullopt;
}

std::uint64_t PacedCan::bits_of(const CanFrame& frame) const noexcept {
  if (!frame.is_fd) {
    return worst_can_bits(frame.size);
  }
  const CanFdBits bits = worst_can_fd_bits(frame.size);
  return bits.nominal + (bits.data * bit_per_s_ + data_bit_per_s_ - 1) / data_bit_per_s_;
}

core::Status PacedCan::send(std::span<const CanFrame> frames) noexcept {
  const core::Nanoseconds now_ns = clock_.now_ns();
  for (const CanFrame& frame : frames) {
    (void)pacer_.reserve(now_ns, bits_of(frame));
  }
  return bus_.send(frames);
}

core::Result<std::size_t> PacedCan::receive(std::span<CanFrame> into,
                                            core::Nanoseconds timeout_ns) noexcept {
  const core::Nanoseconds deadline_ns =
      clock_.now_ns() + std::max<core::Nanoseconds>(timeout_ns, 0);
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

core::Status PacedCan::take_in(core::Nanoseconds timeout_ns) noexcept {
  const std::size_t room = std::min(received_.size(), kCapacity - held_);
  if (room == 0) {
    return {};
  }
  if (ended_.has_value()) {
    const auto size = bus_.receive(std::span(received_).first(room), timeout_ns);
    const core::Nanoseconds now_ns = clock_.now_ns();
    for (std::size_t i = 0; size && i < *size; ++i) {
      under_way_[(first_ + held_++) % kCapacity] = {received_[i],
                                                    pacer_.reserve(now_ns, bits_of(received_[i]))};
    }
    ended_ = size ? core::Status() : core::failure(size.error());
  }
  // The end of the bus comes after the frames that are under way.
  return held_ > 0 ? core::Status() : ended_;
}

std::size_t PacedCan::hand_out(std::span<CanFrame> into) noexcept {
  const core::Nanoseconds now_ns = clock_.now_ns();
  std::size_t size = 0;
  while (held_ > 0 && size < into.size() && under_way_[first_].arrival_ns <= now_ns) {
    into[size++] = under_way_[first_].frame;
    first_ = (first_ + 1) % kCapacity;
    --held_;
  }
  return size;
}

}  // namespace towbench::protocol
