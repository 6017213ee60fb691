// How far a controller is behind a clock that does not wait for it.
//
// One that ends its turns with Advance{T + exchange} answers what it was told at T; of one that
// keeps a clock of its own, each message shows that it is there. Either is expected once an
// exchange, and what is late counts from the controller's first drive on: before it nothing is at
// stake.
#pragma once

#include <algorithm>
#include <string>

#include "core/realtime.h"
#include "core/time.h"
#include "harness/checks/check.h"
#include "harness/realtime/duration_histogram.h"

namespace towbench::harness {

class AnswerWatch {
 public:
  explicit AnswerWatch(core::Nanoseconds exchange_ns) noexcept : exchange_ns_(exchange_ns) {}

  TOWBENCH_REALTIME void heard(core::Nanoseconds now_ns) noexcept {
    heard_ns_ = now_ns;
    shown_ns_ = ends_turns_ ? shown_ns_ : now_ns;
  }
  TOWBENCH_REALTIME void answered(core::Nanoseconds until_ns, core::Nanoseconds now_ns) noexcept {
    heard_ns_ = now_ns;
    ends_turns_ = true;
    // What is said of the future shows nothing yet.
    const auto told_ns = std::min(until_ns - exchange_ns_, now_ns);
    if (told_ns > shown_ns_) {
      shown_ns_ = told_ns;
      latency_.add(now_ns - told_ns);
    }
  }
  // In each tick, behind what came with it.
  TOWBENCH_REALTIME void tick(core::Nanoseconds now_ns, bool drives) noexcept {
    counts_ = counts_ || drives;
    const auto behind_ns = now_ns - shown_ns_ - exchange_ns_;
    if (counts_ && behind_ns > most_behind_ns_) {
      most_behind_ns_ = behind_ns;
      worst_ns_ = shown_ns_ + exchange_ns_;
    }
  }

  [[nodiscard]] core::Nanoseconds silent_ns(core::Nanoseconds now_ns) const noexcept {
    return now_ns - heard_ns_;
  }
  // From what it was told to its answer.
  [[nodiscard]] const DurationHistogram& latency() const noexcept { return latency_; }
  [[nodiscard]] core::Nanoseconds most_behind_ns() const noexcept { return most_behind_ns_; }
  // What was then not answered.
  [[nodiscard]] core::Nanoseconds worst_ns() const noexcept { return worst_ns_; }
  // A reaction may take 2 ms (ANY-2): one exchange until the controller is told, and the rest until
  // it answers; the answer to what is told in the next exchange is never asked for earlier.
  [[nodiscard]] core::Nanoseconds limit_ns() const noexcept {
    constexpr core::Nanoseconds kReaction_ns = 2 * core::kNanosecondsPerMillisecond;
    return std::max(exchange_ns_, kReaction_ns - exchange_ns_);
  }

 private:
  core::Nanoseconds exchange_ns_;
  bool ends_turns_ = false;
  bool counts_ = false;
  core::Nanoseconds heard_ns_ = 0;
  core::Nanoseconds shown_ns_ = 0;  // it has answered everything up to then
  core::Nanoseconds most_behind_ns_ = 0;
  core::Nanoseconds worst_ns_ = 0;
  DurationHistogram latency_;
};

// INVALID above the limit: the host may have kept the controller waiting, and then a run proves
// nothing about it.
[[nodiscard]] Check controller_on_time(const AnswerWatch& answers);

}  // namespace towbench::harness
