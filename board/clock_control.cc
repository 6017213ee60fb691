#include "board/clock_control.h"

#include <algorithm>
#include <array>
#include <utility>

namespace towbench::board {
namespace {

// Clock state controls of CM_PER and CM_WKUP.
constexpr std::array<std::uint32_t, 12> kStateControls{0x000, 0x004, 0x00C, 0x11C, 0x12C, 0x140,
                                                       0x144, 0x148, 0x400, 0x418, 0x4CC, 0x14C};

struct Dpll {
  std::uint32_t mode = 0;
  std::uint32_t status = 0;
};
constexpr std::array<Dpll, 5> kDplls{
    {{0x488, 0x420}, {0x48C, 0x470}, {0x490, 0x45C}, {0x494, 0x434}, {0x498, 0x448}}};
constexpr std::uint32_t kLock = 7;
constexpr std::uint32_t kLocked = 1U;
constexpr std::uint32_t kBypassed = 1U << 8U;

struct TimerSelect {
  std::uint32_t offset = 0;
  unsigned timer = 0;
};
constexpr std::array<TimerSelect, 6> kTimerSelects{
    {{0x504, 7}, {0x508, 2}, {0x50C, 3}, {0x510, 4}, {0x518, 5}, {0x51C, 6}}};
constexpr std::uint32_t kSelectOscillator = 1;

template <typename Table, typename Match>
auto found(const Table& table, Match match) {
  const auto at = std::find_if(table.begin(), table.end(), match);
  return at == table.end() ? nullptr : &*at;
}

}  // namespace

ClockControl::ClockControl(Bus& bus, TimerClock timer_clock)
    : RegisterBlock("clock control", 0x1000, bus), timer_clock_(std::move(timer_clock)) {
  ClockControl::reset();
}

void ClockControl::reset() {
  RegisterBlock::reset();
  for (const Dpll& dpll : kDplls) {
    stored(dpll.mode) = kLock;
  }
  for (const TimerSelect& select : kTimerSelects) {
    stored(select.offset) = kSelectOscillator;
    timer_clock_(select.timer, kSelectOscillator);
  }
}

std::uint32_t ClockControl::read_word(std::uint32_t offset, std::uint32_t /*lanes*/) {
  if (std::find(kStateControls.begin(), kStateControls.end(), offset) != kStateControls.end()) {
    return stored(offset) | ~3U;
  }
  if (const auto* dpll = found(kDplls, [&](const Dpll& d) { return d.status == offset; })) {
    return (stored(dpll->mode) & 7U) == kLock ? kLocked : kBypassed;
  }
  return stored(offset) & ~(3U << 16U);  // IDLEST
}

void ClockControl::write_word(std::uint32_t offset, std::uint32_t value, std::uint32_t lanes) {
  keep(offset, value, lanes);
  if (const auto* select =
          found(kTimerSelects, [&](const TimerSelect& s) { return s.offset == offset; })) {
    timer_clock_(select->timer, stored(offset) & 3U);
  }
}

}  // namespace towbench::board
