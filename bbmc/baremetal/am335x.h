// The registers of the AM335x that BBMC uses (TRM SPRUH73), by address.
#pragma once

#include <array>
#include <cstdint>

#include "core/axis.h"

namespace towbench::bbmc::am335x {

inline volatile std::uint32_t& word(std::uint32_t address) noexcept {
  return *reinterpret_cast<volatile std::uint32_t*>(address);
}
inline volatile std::uint16_t& half(std::uint32_t address) noexcept {
  return *reinterpret_cast<volatile std::uint16_t*>(address);
}

// Clocks: MODULEMODE = 2 enables a module (TRM 8.1.12.1).
inline constexpr std::uint32_t kClockPer = 0x44E0'0000;
inline constexpr std::uint32_t kModuleEnabled = 2;
inline constexpr std::array<std::uint32_t, 5> kModuleClocks{kClockPer + 0x80,   // TIMER2
                                                            kClockPer + 0x7C,   // TIMER7
                                                            kClockPer + 0xAC,   // GPIO1
                                                            kClockPer + 0xCC,   // EPWMSS1
                                                            kClockPer + 0xD8};  // EPWMSS2
inline constexpr std::uint32_t kPwmTimeBases = 0x44E1'0664;  // TBCLKEN of eHRPWM0..2

// UART0.
inline constexpr std::uint32_t kUart = 0x44E0'9000;
inline constexpr std::uint32_t kUartData = kUart + 0x00;
inline constexpr std::uint32_t kUartDivisorHigh = kUart + 0x04;
inline constexpr std::uint32_t kUartFifoControl = kUart + 0x08;
inline constexpr std::uint32_t kUartLineControl = kUart + 0x0C;
inline constexpr std::uint32_t kUartLineStatus = kUart + 0x14;
inline constexpr std::uint32_t kUartMode = kUart + 0x20;
inline constexpr std::uint32_t kUartTransmitLevel = kUart + 0x68;

// DMTIMER2 paces the control, DMTIMER7 runs free.
inline constexpr std::uint32_t kPaceTimer = 0x4804'0000;
inline constexpr std::uint32_t kFreeTimer = 0x4804'A000;
inline constexpr std::uint32_t kTimerStatus = 0x28;
inline constexpr std::uint32_t kTimerEnableSet = 0x2C;
inline constexpr std::uint32_t kTimerControl = 0x38;
inline constexpr std::uint32_t kTimerCounter = 0x3C;
inline constexpr std::uint32_t kTimerReload = 0x40;

// GPIO1.
inline constexpr std::uint32_t kGpio = 0x4804'C000;
inline constexpr std::uint32_t kGpioStatus0 = kGpio + 0x2C;
inline constexpr std::uint32_t kGpioStatus1 = kGpio + 0x30;
inline constexpr std::uint32_t kGpioEnable0 = kGpio + 0x34;
inline constexpr std::uint32_t kGpioEnable1 = kGpio + 0x38;
inline constexpr std::uint32_t kGpioDisable0 = kGpio + 0x3C;
inline constexpr std::uint32_t kGpioDisable1 = kGpio + 0x40;
inline constexpr std::uint32_t kGpioDirection = kGpio + 0x134;  // 1 = input
inline constexpr std::uint32_t kGpioIn = kGpio + 0x138;
inline constexpr std::uint32_t kGpioRising = kGpio + 0x148;
inline constexpr std::uint32_t kGpioFalling = kGpio + 0x14C;
inline constexpr std::uint32_t kGpioClear = kGpio + 0x190;
inline constexpr std::uint32_t kGpioSet = kGpio + 0x194;

// AINTC.
inline constexpr std::uint32_t kAintc = 0x4820'0000;
inline constexpr std::uint32_t kAintcNumber = kAintc + 0x40;
inline constexpr std::uint32_t kAintcControl = kAintc + 0x48;
inline constexpr std::uint32_t kAintcPriority = kAintc + 0x60;
inline constexpr std::uint32_t kAintcThreshold = kAintc + 0x68;
inline constexpr std::uint32_t mask_set(unsigned n) noexcept {
  return kAintc + 0x8C + 0x20 * (n / 32);
}
inline constexpr std::uint32_t mask_clear(unsigned n) noexcept {
  return kAintc + 0x88 + 0x20 * (n / 32);
}
inline constexpr std::uint32_t line_register(unsigned n) noexcept {
  return kAintc + 0x100 + 4 * n;
}
inline constexpr unsigned kPaceInterrupt = 68;
inline constexpr unsigned kUrgentLinesInterrupt = 98;  // GPIO1, line 0
inline constexpr unsigned kOtherLinesInterrupt = 99;   // GPIO1, line 1

// PWMSS1 drives Y, PWMSS2 drives X.
[[nodiscard]] constexpr std::uint32_t pwm_subsystem(core::Axis axis) noexcept {
  return axis == core::Axis::kY ? 0x4830'2000U : 0x4830'4000U;
}
[[nodiscard]] constexpr std::uint32_t encoder(core::Axis axis) noexcept {
  return pwm_subsystem(axis) + 0x180;
}
[[nodiscard]] constexpr std::uint32_t pwm(core::Axis axis) noexcept {
  return pwm_subsystem(axis) + 0x200;
}

}  // namespace towbench::bbmc::am335x
