#include "board/pwm_waveform.h"

#include <algorithm>

namespace towbench::board {
namespace {

enum Event : unsigned {
  kZero = 0,
  kPeriod = 2,
  kCompareAUp = 4,
  kCompareADown = 6,
  kCompareBUp = 8,
  kCompareBDown = 10
};

struct Moment {
  std::uint32_t tick = 0;
  unsigned rank = 0;  // of moments at the same tick the last to act wins
  unsigned event = kZero;
};

// The events of one cycle in the order in which they act.
struct Cycle {
  std::array<Moment, 6> moments{};
  std::size_t size = 0;

  // Kept in order by insertion: at most six.
  void add(std::uint32_t tick, unsigned rank, unsigned event) noexcept {
    std::size_t at = size++;
    for (; at > 0 && (moments[at - 1].tick > tick ||
                      (moments[at - 1].tick == tick && moments[at - 1].rank > rank));
         --at) {
      moments[at] = moments[at - 1];
    }
    moments[at] = {tick, rank, event};
  }
};

// Priorities of TRM Tables 15-19 to 15-21: the more urgent event acts last at its tick.
Cycle cycle_of(const PwmChannel& channel) {
  Cycle cycle;
  const std::uint32_t top = channel.period;
  const std::uint32_t a = channel.compare_a;
  const std::uint32_t b = channel.compare_b;
  switch (channel.mode) {
    case CountMode::kUp:
      cycle.add(0, 0, kZero);
      if (a <= top) {
        cycle.add(a, 1, kCompareAUp);
      }
      if (b <= top) {
        cycle.add(b, 2, kCompareBUp);
      }
      cycle.add(top, 3, kPeriod);
      break;
    case CountMode::kDown:  // the cycle begins at TBPRD
      cycle.add(0, 0, kPeriod);
      // A compare value above the period acts at the period (TRM: CMP > TBPRD).
      cycle.add(top - std::min(a, top), 1, kCompareADown);
      cycle.add(top - std::min(b, top), 2, kCompareBDown);
      cycle.add(top, 3, kZero);
      break;
    case CountMode::kUpDown:
      cycle.add(0, 1, kZero);
      if (a < top) {
        cycle.add(a, 2, kCompareAUp);
      }
      if (b < top) {
        cycle.add(b, 3, kCompareBUp);
      }
      cycle.add(top, 1, kPeriod);
      if (a > 0) {
        cycle.add(2 * top - std::min(a, top), 2, kCompareADown);
      }
      if (b > 0) {
        cycle.add(2 * top - std::min(b, top), 3, kCompareBDown);
      }
      break;
    case CountMode::kStopped:
      break;
  }
  return cycle;
}

bool apply(std::uint16_t actions, unsigned event, bool level) noexcept {
  switch ((std::uint32_t{actions} >> event) & 3U) {
    case 1:
      return false;
    case 2:
      return true;
    case 3:
      return !level;
    default:
      return level;
  }
}

// Ticks high of one cycle; `level` becomes the level at its end.
std::uint32_t run(const PwmChannel& channel, const Cycle& cycle, std::uint32_t ticks,
                  bool& level) noexcept {
  std::uint32_t high = 0;
  std::uint32_t since = 0;
  for (std::size_t i = 0; i < cycle.size && cycle.moments[i].tick < ticks; ++i) {
    const Moment& moment = cycle.moments[i];
    high += level ? moment.tick - since : 0;
    since = moment.tick;
    level = apply(channel.actions, moment.event, level);
  }
  return high + (level ? ticks - since : 0);
}

}  // namespace

std::uint32_t cycle_ticks(const PwmChannel& channel) noexcept {
  const std::uint32_t ticks =
      channel.mode == CountMode::kUpDown ? 2 * channel.period : channel.period + 1;
  return std::max(ticks, 1U);
}

PwmShare share_of(const PwmChannel& channel, bool level_before) noexcept {
  const std::uint32_t ticks = cycle_ticks(channel);
  if (channel.mode == CountMode::kStopped) {
    return {level_before ? ticks : 0, ticks};
  }
  const Cycle cycle = cycle_of(channel);
  bool level = level_before;
  static_cast<void>(run(channel, cycle, ticks, level));  // into the steady state
  const std::uint32_t first = run(channel, cycle, ticks, level);
  const std::uint32_t second = run(channel, cycle, ticks, level);
  return {(first + second) / 2, ticks};
}

bool level_after(const PwmChannel& channel, bool level_before, std::uint32_t ticks) noexcept {
  if (channel.mode == CountMode::kStopped) {
    return level_before;
  }
  const Cycle cycle = cycle_of(channel);
  bool level = level_before;
  static_cast<void>(run(channel, cycle, cycle_ticks(channel), level));
  static_cast<void>(run(channel, cycle, ticks + 1, level));
  return level;
}

}  // namespace towbench::board
