// Registers, flags and control bits of the eQEP (AM335x TRM 15.4.3).
#pragma once

#include <cstdint>

#include "core/time.h"

namespace towbench::board::eqep {

enum Register : std::uint32_t {
  kPosition = 0x00,
  kInitial = 0x04,
  kMaximum = 0x08,
  kPositionCompare = 0x0C,
  kIndexLatch = 0x10,
  kPositionLatch = 0x18,
  kUnitTimer = 0x1C,
  kUnitPeriod = 0x20,
  kWatchdog = 0x24,
  kDecoderControl = 0x28,
  kQepControl = 0x2A,
  kCaptureControl = 0x2C,
  kCompareControl = 0x2E,
  kInterruptEnable = 0x30,
  kFlags = 0x32,
  kClear = 0x34,
  kForce = 0x36,
  kStatus = 0x38,
  kCaptureTimer = 0x3A,
  kCapturePeriod = 0x3C,
  kCaptureTimerLatch = 0x3E,
  kCapturePeriodLatch = 0x40,
  kRevision = 0x5C,
};
enum Flag : std::uint16_t {
  kInterruptFlag = 1U << 0U,
  kPhaseError = 1U << 2U,
  kDirectionChange = 1U << 3U,
  kWatchdogTimeOut = 1U << 4U,
  kUnderflow = 1U << 5U,
  kOverflow = 1U << 6U,
  kCompareMatch = 1U << 8U,
  kIndexEvent = 1U << 10U,
  kUnitTimeOut = 1U << 11U,
};
enum Status : std::uint16_t {
  kFirstIndex = 1U << 1U,
  kDirectionError = 1U << 2U,
  kCaptureOverflow = 1U << 3U,
  kIndexDirection = 1U << 4U,
  kForward = 1U << 5U,
  kFirstIndexDirection = 1U << 6U,
  kUnitPosition = 1U << 7U,
};
inline constexpr std::uint16_t kClearableStatus =
    kFirstIndex | kDirectionError | kCaptureOverflow | kUnitPosition;
inline constexpr std::uint16_t kWatchdogEnable = 1U << 0U;
inline constexpr std::uint16_t kUnitEnable = 1U << 1U;
inline constexpr std::uint16_t kLatchOnUnit = 1U << 2U;
inline constexpr std::uint16_t kCounterEnable = 1U << 3U;
inline constexpr std::uint16_t kSoftwareInit = 1U << 7U;
inline constexpr std::uint16_t kSwap = 1U << 10U;
inline constexpr std::uint16_t kCaptureEnable = 1U << 15U;
inline constexpr core::Nanoseconds kClock_ns = 10;  // 100 MHz
inline constexpr std::int64_t kCaptureRange = 65'536;

}  // namespace towbench::board::eqep
