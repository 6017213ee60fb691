// Whether index pulses come where they must: at the same count modulo one turn, and not later than
// 1.1 turns after the last one.
#pragma once

#include <array>
#include <cstdint>

#include "core/realtime.h"

namespace towbench::bbmc {

class IndexWatch {
 public:
  IndexWatch(std::int64_t counts_per_turn, std::int64_t tolerance_counts) noexcept
      : turn_(counts_per_turn), tolerance_(tolerance_counts) {}

  // `pulses` new ones, the last of them at `pulse_count`; the axis is at `count`, unwrapped, and
  // has moved by `change`. False when an index pulse is missing or off its place.
  TOWBENCH_REALTIME [[nodiscard]] bool update(std::int64_t count, std::int64_t change,
                                              std::uint32_t pulses,
                                              std::int64_t pulse_count) noexcept {
    if (!started_) {
      started_ = true;
      last_seen_ = count;
    }
    if (pulses > 0) {
      last_seen_ = pulse_count;
      // A pulse has a width: its place depends on the side from which it was entered.
      Place& place = places_[change >= 0 ? 0 : 1];
      if (!place.known) {
        place = {true, pulse_count};
        return true;
      }
      return on_place(pulse_count - place.count);
    }
    const std::int64_t since = count - last_seen_;
    return (since < 0 ? -since : since) <= turn_ + turn_ / 10 + tolerance_;
  }

  // What has been learnt is forgotten, e.g. after a fault was reset.
  void forget() noexcept {
    started_ = false;
    places_ = {};
  }

 private:
  struct Place {
    bool known = false;
    std::int64_t count = 0;
  };

  [[nodiscard]] bool on_place(std::int64_t distance) const noexcept {
    std::int64_t rest = distance % turn_;
    rest = rest < 0 ? rest + turn_ : rest;
    return rest <= tolerance_ || turn_ - rest <= tolerance_;
  }

  std::int64_t turn_;
  std::int64_t tolerance_;
  std::int64_t last_seen_ = 0;
  std::array<Place, 2> places_{};
  bool started_ = false;
};

}  // namespace towbench::bbmc
