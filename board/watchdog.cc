#include "board/watchdog.h"

#include <utility>

namespace towbench::board {
namespace {

constexpr std::uint32_t kStatus = 0x14;
constexpr std::uint32_t kWatchdogControl = 0x24;
constexpr std::uint32_t kWatchdogCounter = 0x28;
constexpr std::uint32_t kWatchdogLoad = 0x2C;
constexpr std::uint32_t kWatchdogTrigger = 0x30;
constexpr std::uint32_t kPending = 0x34;
constexpr std::uint32_t kStartStop = 0x48;

constexpr std::int64_t kWatchdogClock_Hz = 32'768;
constexpr std::uint32_t kPrescales = 1U << 5U;

}  // namespace

Watchdog::Watchdog(std::string name, std::uint32_t size, Bus& bus)
    : RegisterBlock(std::move(name), size, bus) {
  reset();
}

void Watchdog::reset() {
  RegisterBlock::reset();
  stored(kWatchdogControl) = kPrescales;
  loaded_ns_ = now_ns_;
  loaded_count_ = 0;
  sequence_ = 0;
  running_ = false;
  expired_ = false;
}

std::int64_t Watchdog::clocks_per_tick() const noexcept {
  const auto control = stored(kWatchdogControl);
  return (control & kPrescales) == 0 ? 1 : std::int64_t{1} << (control >> 2U & 7U);
}

std::uint64_t Watchdog::elapsed() const noexcept {
  // In two steps: a day of nanoseconds times the clock does not fit.
  const auto span_ns = now_ns_ - loaded_ns_;
  const auto seconds = span_ns / core::kNanosecondsPerSecond;
  const auto rest_ns = span_ns % core::kNanosecondsPerSecond;
  const auto clocks =
      seconds * kWatchdogClock_Hz + rest_ns * kWatchdogClock_Hz / core::kNanosecondsPerSecond;
  return static_cast<std::uint64_t>(clocks / clocks_per_tick());
}

std::uint32_t Watchdog::counter() const noexcept {
  return loaded_count_ + (running_ ? static_cast<std::uint32_t>(elapsed()) : 0U);
}

core::Nanoseconds Watchdog::next_event_ns() const {
  if (!running_ || expired_) {
    return kNever;
  }
  const auto clocks = ((std::int64_t{1} << 32) - loaded_count_) * clocks_per_tick();
  const auto seconds = clocks / kWatchdogClock_Hz;
  const auto rest = clocks % kWatchdogClock_Hz;
  return loaded_ns_ + seconds * core::kNanosecondsPerSecond +
         (rest * core::kNanosecondsPerSecond + kWatchdogClock_Hz - 1) / kWatchdogClock_Hz;
}

void Watchdog::advance(core::Nanoseconds now_ns) {
  if (now_ns >= next_event_ns()) {
    expired_ = true;
  }
  now_ns_ = now_ns;
}

void Watchdog::load_counter(std::uint32_t count) {
  loaded_count_ = count;
  loaded_ns_ = now_ns_;
}

void Watchdog::take_start_or_stop(std::uint32_t value) {
  if (sequence_ == 0xBBBB && value == 0x4444) {
    load_counter(counter());
    running_ = true;
  } else if (sequence_ == 0xAAAA && value == 0x5555) {
    load_counter(counter());
    running_ = false;
  }
  sequence_ = value;
}

std::uint32_t Watchdog::read_word(std::uint32_t offset, std::uint32_t /*lanes*/) {
  switch (offset) {
    case kStatus:
      return 1;  // its own reset is over
    case kWatchdogCounter:
      bus().disturb();
      return counter();
    case kPending:
      return 0;
    default:
      return stored(offset);
  }
}

void Watchdog::write_word(std::uint32_t offset, std::uint32_t value, std::uint32_t lanes) {
  const auto before = stored(offset);
  const auto count = counter();
  keep(offset, value, lanes);
  switch (offset) {
    case kWatchdogControl:
      load_counter(count);  // goes on from there at the new rate
      break;
    case kWatchdogCounter:
      load_counter(stored(offset));
      break;
    case kWatchdogTrigger:
      if (stored(offset) != before) {
        load_counter(stored(kWatchdogLoad));
      }
      break;
    case kStartStop:
      take_start_or_stop(stored(offset));
      break;
    default:
      break;
  }
}

}  // namespace towbench::board
