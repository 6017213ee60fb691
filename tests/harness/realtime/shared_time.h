// A plant and a controller, each in a thread with a loop by "the wall clock", in a time that both
// share and that only moves when both wait: runs by the wall clock without a wall clock, the same
// every time.
//
// Between two threads only one is ever awake: the one whose wake-up comes first, the plant before
// the controller. A controller that waits for the wire instead of the clock stands aside until the
// plant has sent something.
#pragma once

#include <algorithm>
#include <array>
#include <chrono>
#include <condition_variable>
#include <deque>
#include <mutex>
#include <span>

#include "harness/realtime/tick_clock.h"
#include "protocol/byte_stream.h"
#include "protocol/carriers/can_port.h"

namespace towbench::harness {

enum class Who : std::uint8_t { kPlant, kController };

class SharedTime {
 public:
  [[nodiscard]] core::Nanoseconds now_ns() {
    const std::lock_guard lock(mutex_);
    return now_ns_;
  }
  void sleep_until(Who who, core::Nanoseconds time_ns) {
    std::unique_lock lock(mutex_);
    Side& me = side(who);
    me.wake_ns = std::max(time_ns, now_ns_);
    me.asleep = true;
    me.aside = me.gone;
    changed_.notify_all();
    changed_.wait(lock, [&] { return is_next(who); });
    me.asleep = false;
    now_ns_ = me.wake_ns;
  }
  void stand_aside(Who who, bool aside) {
    const std::lock_guard lock(mutex_);
    side(who).aside = aside || side(who).gone;
    changed_.notify_all();
  }
  // For good: the other one need not wait for it any more.
  void leave(Who who) {
    const std::lock_guard lock(mutex_);
    side(who).gone = side(who).aside = true;
    changed_.notify_all();
  }

 private:
  struct Side {
    core::Nanoseconds wake_ns = 0;
    bool asleep = false;
    bool aside = true;
    bool gone = false;
  };
  Side& side(Who who) { return sides_[static_cast<std::size_t>(who)]; }
  bool is_next(Who who) {
    const Side& me = side(who);
    const Side& other = side(who == Who::kPlant ? Who::kController : Who::kPlant);
    const bool before =
        who == Who::kPlant ? me.wake_ns <= other.wake_ns : me.wake_ns < other.wake_ns;
    return other.aside || (other.asleep && before);
  }

  std::mutex mutex_;
  std::condition_variable changed_;
  core::Nanoseconds now_ns_ = 0;
  std::array<Side, 2> sides_;
};

class SharedClock final : public TickClock {
 public:
  SharedClock(SharedTime& time, Who who) : time_(time), who_(who) {}
  [[nodiscard]] core::Nanoseconds now_ns() noexcept override { return time_.now_ns(); }
  void sleep_until(core::Nanoseconds time_ns) noexcept override {
    time_.sleep_until(who_, time_ns);
  }

 private:
  SharedTime& time_;
  Who who_;
};

// One direction of a wire in memory.
template <typename Item>
class SharedQueue {
 public:
  SharedQueue(SharedTime& time, Who receiver) : time_(time), receiver_(receiver) {}

  void put(std::span<const Item> items) {
    {
      const std::lock_guard lock(mutex_);
      items_.insert(items_.end(), items.begin(), items.end());
    }
    time_.stand_aside(receiver_, false);
    changed_.notify_all();
  }
  std::size_t take(std::span<Item> into, bool wait) {
    std::unique_lock lock(mutex_);
    if (wait && items_.empty()) {
      time_.stand_aside(receiver_, true);
      constexpr std::chrono::seconds kSomebodyIsStuck{2};
      changed_.wait_for(lock, kSomebodyIsStuck, [&] { return !items_.empty(); });
    }
    const std::size_t size = std::min(into.size(), items_.size());
    const auto end = items_.begin() + static_cast<std::ptrdiff_t>(size);
    std::copy(items_.begin(), end, into.begin());
    items_.erase(items_.begin(), end);
    return size;
  }

 private:
  SharedTime& time_;
  Who receiver_;
  std::mutex mutex_;
  std::condition_variable changed_;
  std::deque<Item> items_;
};

class SharedStream final : public protocol::ByteStream {
 public:
  SharedStream(SharedQueue<std::byte>& out, SharedQueue<std::byte>& in) : out_(out), in_(in) {}
  core::Status write(std::span<const std::byte> bytes) noexcept override {
    out_.put(bytes);
    return {};
  }
  core::Result<std::size_t> read_some(std::span<std::byte> into,
                                      core::Nanoseconds timeout_ns) noexcept override {
    return in_.take(into, timeout_ns > 0);
  }

 private:
  SharedQueue<std::byte>& out_;
  SharedQueue<std::byte>& in_;
};

class SharedBus final : public protocol::CanPort {
 public:
  SharedBus(SharedQueue<protocol::CanFrame>& out, SharedQueue<protocol::CanFrame>& in)
      : out_(out), in_(in) {}
  core::Status send(std::span<const protocol::CanFrame> frames) noexcept override {
    out_.put(frames);
    return {};
  }
  core::Result<std::size_t> receive(std::span<protocol::CanFrame> into,
                                    core::Nanoseconds timeout_ns) noexcept override {
    return in_.take(into, timeout_ns > 0);
  }

 private:
  SharedQueue<protocol::CanFrame>& out_;
  SharedQueue<protocol::CanFrame>& in_;
};

}  // namespace towbench::harness
