#include "protocol/carriers/turn_link.h"

#include <chrono>
#include <optional>

namespace towbench::protocol {
namespace {

using Clock = std::chrono::steady_clock;

}  // namespace

core::Result<Turn> TurnLink::wait(MessageSink& here) noexcept {
  std::optional<Turn> turn;
  const core::Status status = wait_until(
      [&] {
        for (std::size_t i = 0; i < kTurnCount && !turn; ++i) {
          if (watch_.take(static_cast<Turn>(i))) {
            turn = static_cast<Turn>(i);
          }
        }
        return turn.has_value();
      },
      here);
  if (!turn) {
    return core::failure(status.error());
  }
  return *turn;
}

core::Status TurnLink::wait_for(Turn expected, MessageSink& here) noexcept {
  bool expected_came = false;
  const core::Status status = wait_until(
      [&] {
        expected_came = watch_.take(expected);
        return expected_came || watch_.has(Turn::kBye);
      },
      here);
  if (!status || expected_came) {
    return status;
  }
  return core::failure(core::ErrorCode::kPeerClosed);
}

core::Result<bool> TurnLink::listen(MessageSink& here, core::Nanoseconds timeout_ns) noexcept {
  watch_.pass_to(here);
  if (lost_.has_value()) {
    if (const auto progress = read_once(timeout_ns); !progress) {
      lost_ = core::failure(progress.error());
    }
  }
  if (!lost_.has_value()) {
    return core::failure(lost_.error());
  }
  bool ended = false;
  for (std::size_t i = 0; i < kTurnCount; ++i) {
    ended = ended || watch_.has(static_cast<Turn>(i));
  }
  return ended;
}

template <typename Predicate>
core::Status TurnLink::wait_until(Predicate is_over, MessageSink& here) noexcept {
  watch_.pass_to(here);
  if (is_over()) {
    return {};
  }
  const auto deadline = Clock::now() + std::chrono::nanoseconds(silence_limit_ns_);
  core::Nanoseconds left_ns = silence_limit_ns_;
  while (lost_.has_value()) {
    if (left_ns <= 0) {
      lost_ = core::failure(core::ErrorCode::kPeerSilent);
      break;
    }
    const auto progress = read_once(left_ns);
    if (!progress) {
      lost_ = core::failure(progress.error());
    } else if (*progress == Progress::kSomething && is_over()) {
      return {};
    } else {
      left_ns = std::chrono::nanoseconds(deadline - Clock::now()).count();
    }
  }
  return lost_;
}

}  // namespace towbench::protocol
