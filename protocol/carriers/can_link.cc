#include "protocol/carriers/can_link.h"

namespace towbench::protocol {
namespace {

constexpr CanDirection opposite(CanDirection direction) noexcept {
  return direction == CanDirection::kToPlant ? CanDirection::kToController : CanDirection::kToPlant;
}

}  // namespace

CanLink::CanLink(CanPort& port, CanDirection direction, core::Nanoseconds silence_limit_ns) noexcept
    : TurnLink(silence_limit_ns),
      port_(port),
      writer_(*this, direction),
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
    for (std::size_t i = 0; link.log_ != nullptr && i < turn.size(); ++i) {
      link.log_->on(turn[i]);
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
    unpacker_.take(received_[i], watch());
  }
  return Progress::kSomething;
}

}  // namespace towbench::protocol
