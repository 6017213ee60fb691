#include "protocol/carriers/can_link.h"

namespace towbench::protocol {
namespace {

constexpr CanDirection opposite(CanDirection direction) noexcept {
  return direction == CanDirection::kToPlant ? CanDirection::kToController : CanDirection::kToPlant;
}

std::uint64_t bits_of(const CanFrame& frame) noexcept {
  const CanFdBits fd = worst_can_fd_bits(frame.size);
  return frame.is_fd ? fd.nominal + fd.data : worst_can_bits(frame.size);
}

}  // namespace

CanLink::CanLink(CanPort& port, CanDirection direction, core::Nanoseconds silence_limit_ns) noexcept
    : TurnLink(silence_limit_ns),
      port_(port),
      writer_(*this, direction, port.carries_fd()),
      unpacker_(opposite(direction)) {}

void CanLink::Queue::on(const CanFrame& frame) noexcept {
  if (held == frames.size()) {
    flush();
  }
  frames[held++] = frame;
}

void CanLink::Queue::flush() noexcept {
  const auto turn = std::span<const CanFrame>(frames).first(held);
  held = 0;
  if (!status.has_value()) {
    return;
  }
  status = link.port_.send(turn);
  if (status.has_value()) {
    link.writer_.frames_sent += turn.size();
    for (const CanFrame& frame : turn) {
      link.writer_.bits_sent += bits_of(frame);
      if (link.log_ != nullptr) {
        link.log_->on(frame);
      }
    }
  }
}

core::Result<CanLink::Progress> CanLink::read_once(core::Nanoseconds timeout_ns) noexcept {
  if (const auto sent = writer_.queue.status; !sent) {
    return core::failure(sent.error());
  }
  const auto size = port_.receive(received_, timeout_ns);
  if (!size) {
    return core::failure(size.error());
  }
  if (*size == 0) {
    return Progress::kNothing;
  }
  frames_received_ += *size;
  for (std::size_t i = 0; i < *size; ++i) {
    if (log_ != nullptr) {
      log_->on(received_[i]);
    }
    bits_received_ += bits_of(received_[i]);
    unpacker_.take(received_[i], hearer_);
  }
  return Progress::kSomething;
}

}  // namespace towbench::protocol
