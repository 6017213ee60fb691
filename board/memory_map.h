// Where everything of the virtual board lies (AM335x TRM chapter 2; interrupt numbers from Table
// 6-1).
#pragma once

#include <array>
#include <cstdint>

namespace towbench::board {

struct Place {
  std::uint32_t address = 0;
  std::uint32_t size = 0;
};

// RAM.
inline constexpr Place kSram{0x402F'0000, 0x1'0000};
inline constexpr Place kOcmc{0x4030'0000, 0x1'0000};
inline constexpr Place kDdr{0x8000'0000, 0x1000'0000};

// Peripherals.
inline constexpr std::uint32_t kClockControlAddress = 0x44E0'0000;
inline constexpr std::uint32_t kControlModuleAddress = 0x44E1'0000;
inline constexpr std::uint32_t kUart0Address = 0x44E0'9000;
inline constexpr std::uint32_t kAintcAddress = 0x4820'0000;

inline constexpr unsigned kUart0Interrupt = 72;

struct TimerPlace {
  unsigned number = 0;
  std::uint32_t address = 0;
  unsigned interrupt = 0;
};
inline constexpr std::array<TimerPlace, 7> kTimers{{{0, 0x44E0'5000, 66},
                                                    {2, 0x4804'0000, 68},
                                                    {3, 0x4804'2000, 69},
                                                    {4, 0x4804'4000, 92},
                                                    {5, 0x4804'6000, 93},
                                                    {6, 0x4804'8000, 94},
                                                    {7, 0x4804'A000, 95}}};

struct GpioPlace {
  unsigned number = 0;
  std::uint32_t address = 0;
  std::array<unsigned, 2> interrupts{};
};
inline constexpr std::array<GpioPlace, 4> kGpios{{{0, 0x44E0'7000, {96, 97}},
                                                  {1, 0x4804'C000, {98, 99}},
                                                  {2, 0x481A'C000, {32, 33}},
                                                  {3, 0x481A'E000, {62, 63}}}};

struct PwmPlace {
  unsigned number = 0;
  std::uint32_t address = 0;
  unsigned encoder_interrupt = 0;
  unsigned pwm_interrupt = 0;
};
inline constexpr std::array<PwmPlace, 3> kPwmSubsystems{
    {{0, 0x4830'0000, 79, 86}, {1, 0x4830'2000, 88, 87}, {2, 0x4830'4000, 89, 39}}};

}  // namespace towbench::board
