#include "protocol/carriers/lockstep_link.h"

#include <chrono>
#include <optional>

namespace towbench::protocol {
namespace {

using Clock = std::chrono::steady_clock;

}  // namespace

template <typename Writer, typename Reader>
BasicLockstepLink<Writer, Reader>::BasicLockstepLink(ByteStream& stream,
                                                     core::Nanoseconds silence_limit_ns) noexcept
    : stream_(stream), silence_limit_ns_(silence_limit_ns), writer_(stream) {}

template <typename Writer, typename Reader>
core::Result<Turn> BasicLockstepLink<Writer, Reader>::wait(MessageSink& here) noexcept {
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

template <typename Writer, typename Reader>
core::Status BasicLockstepLink<Writer, Reader>::wait_for(Turn expected,
                                                         MessageSink& here) noexcept {
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

template <typename Writer, typename Reader>
template <typename Predicate>
core::Status BasicLockstepLink<Writer, Reader>::wait_until(Predicate is_over,
                                                           MessageSink& here) noexcept {
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
    } else if (*progress == Progress::kBytes && is_over()) {
      return {};
    } else {
      left_ns = std::chrono::nanoseconds(deadline - Clock::now()).count();
    }
  }
  return lost_;
}

template <typename Writer, typename Reader>
auto BasicLockstepLink<Writer, Reader>::read_once(core::Nanoseconds timeout_ns) noexcept
    -> core::Result<Progress> {
  // A peer that has gone may have left a last word: read on. Any other failure to send is final.
  if (const auto sent = writer_.status(); !sent && sent.error() != core::ErrorCode::kPeerClosed) {
    return core::failure(sent.error());
  }
  const auto size = stream_.read_some(received_, timeout_ns);
  if (!size) {
    reader_.finish(watch_);
    return core::failure(size.error());
  }
  if (*size == 0) {
    return Progress::kNothing;
  }
  bytes_received_ += *size;
  reader_.feed(std::span(received_).first(*size), watch_);
  return Progress::kBytes;
}

template class BasicLockstepLink<FrameWriter, FrameReader>;
template class BasicLockstepLink<CobsWriter, CobsReader>;

}  // namespace towbench::protocol
