// WDT1 (AM335x TRM 20.4): an up-counter of 32,768 Hz that resets the board when it overflows.
//
//   start     0xBBBB, then 0x4444 to WSPR; stop: 0xAAAA, then 0x5555
//   serve     a value in WTGR that differs from the one before loads the counter from WLDR
//   period    (2^32 - WLDR) 2^PTV / 32,768 s, without WCLR.PRE (2^32 - WLDR) / 32,768 s
//
// It stands when the image starts, as a boot loader leaves it. Writes take effect at once: WWPS is
// 0. Its delay interrupt is not modelled.
#pragma once

#include <cstdint>
#include <string>

#include "board/register_block.h"

namespace towbench::board {

class Watchdog final : public RegisterBlock {
 public:
  Watchdog(std::string name, std::uint32_t size, Bus& bus);

  void advance(core::Nanoseconds now_ns) override;
  [[nodiscard]] core::Nanoseconds next_event_ns() const override;
  void reset() override;

  // Until reset().
  [[nodiscard]] bool expired() const noexcept { return expired_; }

 protected:
  std::uint32_t read_word(std::uint32_t offset, std::uint32_t lanes) override;
  void write_word(std::uint32_t offset, std::uint32_t value, std::uint32_t lanes) override;

 private:
  // Whole ticks since the counter was loaded.
  [[nodiscard]] std::uint64_t elapsed() const noexcept;
  [[nodiscard]] std::uint32_t counter() const noexcept;
  [[nodiscard]] std::int64_t clocks_per_tick() const noexcept;
  void load_counter(std::uint32_t count);
  void take_start_or_stop(std::uint32_t value);

  core::Nanoseconds now_ns_ = 0;
  core::Nanoseconds loaded_ns_ = 0;
  std::uint32_t loaded_count_ = 0;
  std::uint32_t sequence_ = 0;  // the last value written to WSPR
  bool running_ = false;
  bool expired_ = false;
};

}  // namespace towbench::board
