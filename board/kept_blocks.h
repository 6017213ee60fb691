// Known blocks of the AM335x whose registers are kept and do nothing here: what start-up code of a
// board sets and a motion controller does not need (AM335x TRM chapter 2). An image that waits in
// one of them for something to change waits for ever; the board says so (board_end.cc). What it
// reads there may make the run doubtful (kept_registers.h).
#pragma once

#include <array>
#include <cstdint>

namespace towbench::board {

struct KeptBlock {
  const char* name;
  std::uint32_t address;
  std::uint32_t size;
};

inline constexpr std::uint32_t kWatchdogAddress = 0x44E3'5000;
inline constexpr std::uint32_t kWatchdogSize = 0x1000;

inline constexpr std::array kKeptBlocks{
    KeptBlock{"l3 interconnect", 0x4400'0000, 0x1000},
    KeptBlock{"i2c0", 0x44E0'B000, 0x1000},
    KeptBlock{"adc", 0x44E0'D000, 0x1000},
    KeptBlock{"dmtimer1", 0x44E3'1000, 0x1000},
    KeptBlock{"rtc", 0x44E3'E000, 0x1000},
    KeptBlock{"uart1", 0x4802'2000, 0x1000},
    KeptBlock{"uart2", 0x4802'4000, 0x1000},
    KeptBlock{"i2c1", 0x4802'A000, 0x1000},
    KeptBlock{"spi0", 0x4803'0000, 0x1000},
    KeptBlock{"mmc0", 0x4806'0000, 0x1000},
    KeptBlock{"mailbox", 0x480C'8000, 0x1000},
    KeptBlock{"i2c2", 0x4819'C000, 0x1000},
    KeptBlock{"spi1", 0x481A'0000, 0x1000},
    KeptBlock{"uart3", 0x481A'6000, 0x1000},
    KeptBlock{"uart4", 0x481A'8000, 0x1000},
    KeptBlock{"uart5", 0x481A'A000, 0x1000},
    KeptBlock{"mmc1", 0x481D'8000, 0x1000},
    KeptBlock{"edma controller", 0x4900'0000, 0x8000},
    KeptBlock{"edma channel 0", 0x4980'0000, 0x1000},
    KeptBlock{"edma channel 1", 0x4990'0000, 0x1000},
    KeptBlock{"edma channel 2", 0x49A0'0000, 0x1000},
    KeptBlock{"ethernet", 0x4A10'0000, 0x8000},
    KeptBlock{"emif0", 0x4C00'0000, 0x1000},
};

}  // namespace towbench::board
