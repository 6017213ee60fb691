#include "bbmc/baremetal/register_ports.h"

#include "bbmc/baremetal/am335x.h"
#include "bbmc/system/configuration.h"

namespace towbench::bbmc {

using am335x::half;
using am335x::word;
using core::ErrorCode;
using core::failure;
using core::Status;

namespace {

constexpr core::Nanoseconds kTimerTicks = 24;  // in 1,000 ns
constexpr core::Nanoseconds kTimerSpan_ns = 1'000;

// eHRPWM.
constexpr std::uint32_t kTimeBaseControl = 0x00;
constexpr std::uint32_t kPeriod = 0x0A;
constexpr std::uint32_t kCompareControl = 0x0E;
constexpr std::uint32_t kCompareA = 0x12;
constexpr std::uint32_t kCompareB = 0x14;
constexpr std::uint32_t kActionsA = 0x16;
constexpr std::uint32_t kActionsB = 0x18;
constexpr std::uint32_t kTripControl = 0x28;
constexpr std::uint32_t kTripClear = 0x2E;
constexpr std::uint32_t kTripForce = 0x30;
constexpr std::uint16_t kCountUpBy4 = 2U << 7U;      // HSPCLKDIV = /4: 25 MHz, period by shadow
constexpr std::uint16_t kHighAtZeroLowAtA = 0x0012;  // ZRO: high, CAU: low
constexpr std::uint16_t kHighAtZeroLowAtB = 0x0102;  // ZRO: high, CBU: low
constexpr std::uint16_t kTripBothLow = 0x000A;
constexpr std::uint16_t kOneShot = 1U << 2U;

// eQEP.
constexpr std::uint32_t kPosition = 0x00;
constexpr std::uint32_t kMaximum = 0x08;
constexpr std::uint32_t kIndexLatch = 0x10;
constexpr std::uint32_t kDecoderControl = 0x28;
constexpr std::uint32_t kQepControl = 0x2A;
constexpr std::uint32_t kCaptureControl = 0x2C;
constexpr std::uint32_t kFlags = 0x32;
constexpr std::uint32_t kClear = 0x34;
constexpr std::uint32_t kStatus = 0x38;
constexpr std::uint32_t kTimerLatch = 0x3E;
constexpr std::uint32_t kPeriodLatch = 0x40;
constexpr std::uint16_t kRunLatchIndex = 0x1018;  // PCRM: reset at maximum; IEL: rising; QPEN
constexpr std::uint16_t kCaptureOn = 1U << 15U;
constexpr std::uint16_t kPhaseError = 1U << 2U;
constexpr std::uint16_t kIndexEvent = 1U << 10U;
constexpr std::uint16_t kDirectionError = 1U << 2U;
constexpr std::uint16_t kCaptureOverflow = 1U << 3U;
constexpr std::uint16_t kForward = 1U << 5U;
constexpr std::uint16_t kUnitPosition = 1U << 7U;

}  // namespace

// ---- the pace timer ----

void PaceClock::start() noexcept {
  const bool first = !started_;
  if (first) {
    started_ = true;
    service_ns_ = -exchange_ns_;
    word(am335x::kFreeTimer + am335x::kTimerReload) = 0;
    word(am335x::kFreeTimer + am335x::kTimerControl) = 3;  // start, auto-reload
  }
  running_exchange_ns_ = exchange_ns_;
  ticks_ = static_cast<std::uint32_t>(exchange_ns_ * kTimerTicks / kTimerSpan_ns);
  word(am335x::kPaceTimer + am335x::kTimerControl) = 0;
  word(am335x::kPaceTimer + am335x::kTimerReload) = 0U - ticks_;
  // The first exchange begins at once, the second one period later.
  constexpr std::uint32_t kAtOnce_ticks = 10;
  const std::uint32_t wait_ticks = first ? kAtOnce_ticks : ticks_;
  word(am335x::kPaceTimer + am335x::kTimerCounter) = 0U - wait_ticks;
  word(am335x::kPaceTimer + am335x::kTimerEnableSet) = 2;
  // Read before the pace timer runs: an overflow is never seen before its exchange has begun here.
  service_tick_ = word(am335x::kFreeTimer + am335x::kTimerCounter) + wait_ticks - ticks_;
  word(am335x::kPaceTimer + am335x::kTimerControl) = 3;
}

std::uint32_t PaceClock::begun() const noexcept {
  return (word(am335x::kFreeTimer + am335x::kTimerCounter) - service_tick_) / ticks_;
}

void PaceClock::tick() noexcept {
  service_ns_ += running_exchange_ns_;
  service_tick_ += ticks_;
}

core::Nanoseconds PaceClock::now_ns() const noexcept {
  const std::uint32_t since = word(am335x::kFreeTimer + am335x::kTimerCounter) - service_tick_;
  return service_ns_ + static_cast<core::Nanoseconds>(since) * kTimerSpan_ns / kTimerTicks;
}

Status RegisterTimer::apply(const Dmtimer::Settings& settings) noexcept {
  period_ns_ = settings.period_ns;
  clock_->set_exchange(exchange_period_ns(period_ns_));
  if (running_) {
    clock_->start();
  }
  return {};
}

Status RegisterTimer::read(Dmtimer::Reading& reading) noexcept {
  reading = {.time_ns = clock_->now_ns(),
             .next_due_ns = next_due_ns_,
             .ticks = ticks_,
             .running = running_};
  return {};
}

Status RegisterTimer::write(const Dmtimer::Command& command) noexcept {
  switch (command.action) {
    case Dmtimer::Action::kStart:
      running_ = true;
      next_due_ns_ = clock_->service_ns();
      clock_->start();  // whose first service is at 0, or one exchange from the last one
      break;
    case Dmtimer::Action::kStop:
      running_ = false;
      break;
    case Dmtimer::Action::kAcknowledge:
      if (!running_) {
        return failure(ErrorCode::kDeviceNoData);
      }
      ++ticks_;
      next_due_ns_ += period_ns_;
      break;
  }
  return {};
}

// ---- ehrpwm ----

void RegisterPwm::attach(core::Axis axis, LineEdges& edges) noexcept {
  base_ = am335x::pwm(axis);
  edges_ = &edges;
}

Status RegisterPwm::apply(const Ehrpwm::Settings& settings) noexcept {
  half(base_ + kTripControl) = kTripBothLow;
  half(base_ + kTripForce) = kOneShot;
  half(base_ + kPeriod) = static_cast<std::uint16_t>(settings.period_ticks - 1U);
  half(base_ + kCompareControl) = 0;  // shadows, loaded at zero
  half(base_ + kCompareA) = 0;
  half(base_ + kCompareB) = 0;
  half(base_ + kActionsA) = kHighAtZeroLowAtA;
  half(base_ + kActionsB) = kHighAtZeroLowAtB;
  half(base_ + kTimeBaseControl) = kCountUpBy4;
  output_ = {};
  return {};
}

Status RegisterPwm::read(Ehrpwm::Reading& reading) noexcept {
  reading = output_;
  return {};
}

Status RegisterPwm::write(const Ehrpwm::Command& command) noexcept {
  const InterruptsOff off;
  if (!command.enable || edges_->killed()) {
    half(base_ + kTripForce) = kOneShot;
  }
  half(base_ + kCompareA) = command.channel_a_ticks;
  half(base_ + kCompareB) = command.channel_b_ticks;
  if (command.enable && !edges_->killed()) {
    half(base_ + kTripClear) = kOneShot | 1U;
  }
  output_ = command;
  return {};
}

void RegisterPwm::release() noexcept {
  half(base_ + kTripForce) = kOneShot;
  half(base_ + kCompareA) = 0;
  half(base_ + kCompareB) = 0;
  output_ = {};
}

// ---- eqep ----

void RegisterEqep::attach(core::Axis axis, const PaceClock& clock) noexcept {
  base_ = am335x::encoder(axis);
  clock_ = &clock;
}

Status RegisterEqep::apply(const Eqep::Settings& settings) noexcept {
  constexpr double kPeripheralClock_Hz = 100e6;
  std::uint16_t prescaler = 0;
  while (prescaler <= 7 &&
         kPeripheralClock_Hz / static_cast<double>(1U << prescaler) != settings.capture_clock_Hz) {
    ++prescaler;
  }
  if (prescaler > 7) {
    return failure(ErrorCode::kDeviceUnsupported);
  }
  word(base_ + kMaximum) = settings.position_max;
  half(base_ + kDecoderControl) = 0;  // quadrature
  half(base_ + kQepControl) = kRunLatchIndex;
  half(base_ + kCaptureControl) = 0;
  half(base_ + kCaptureControl) = static_cast<std::uint16_t>(kCaptureOn | prescaler << 4U);
  half(base_ + kClear) = 0xFFFF;
  half(base_ + kStatus) = 0xFFFF;
  last_.since_edge_ticks = kCaptureSaturation_ticks;
  last_.edges_known = false;  // the peripheral counts, it does not tell edges that cancel
  last_.position = word(base_ + kPosition);
  return {};
}

Status RegisterEqep::read(Eqep::Reading& reading) noexcept {
  const std::uint32_t before = last_.position;
  last_.time_ns = clock_->now_ns();
  last_.position = word(base_ + kPosition);  // latches the capture unit's registers
  const auto change = static_cast<std::int32_t>(last_.position - before);
  const auto counted = static_cast<std::uint32_t>(change < 0 ? -change : change);
  last_.edges += counted;
  read_capture(counted);
  read_flags();
  reading = last_;
  return {};
}

void RegisterEqep::read_capture(std::uint32_t counted) noexcept {
  const std::uint16_t status = half(base_ + kStatus);
  half(base_ + kStatus) = kUnitPosition | kCaptureOverflow | kDirectionError;
  last_.forward = (status & kForward) != 0 || !moved_;
  const bool overflow = (status & kCaptureOverflow) != 0;
  if ((status & kUnitPosition) != 0) {
    // The timer overflows after 42 ms at the earliest: never between two edges of one exchange, so
    // an overflow seen with edges lies before the first of them.
    const bool stale = (overflow || overflowed_) && counted < 2;
    last_.capture_ticks = stale ? kCaptureSaturation_ticks : half(base_ + kPeriodLatch);
    last_.capture_valid = moved_ && !stale && (status & kDirectionError) == 0 &&
                          last_.capture_ticks < kCaptureSaturation_ticks;
    moved_ = true;
    overflowed_ = false;
  } else {
    overflowed_ = overflowed_ || overflow;
  }
  last_.since_edge_ticks =
      !moved_ || overflowed_ ? kCaptureSaturation_ticks : half(base_ + kTimerLatch);
}

void RegisterEqep::read_flags() noexcept {
  const std::uint16_t flags = half(base_ + kFlags);
  half(base_ + kClear) = static_cast<std::uint16_t>(flags | 1U);
  last_.illegal_transitions += (flags & kPhaseError) != 0 ? 1U : 0U;
  if ((flags & kIndexEvent) != 0) {
    ++last_.index_pulses;
    last_.index_position = word(base_ + kIndexLatch);
  }
}

Status RegisterEqep::write(const Eqep::Command& command) noexcept {
  word(base_ + kPosition) = command.position;
  last_.position = command.position;
  return {};
}

}  // namespace towbench::bbmc
