// Finds out that a program runs in a circle in which nothing will change by itself.
//
// A circle: the same block comes again with the same registers and stack, and between no access to
// a peripheral disturbed (bus.h). The first time a loop is seen its memory and its floating-point
// registers are compared over one more round as well; a loop that changes them never counts as
// idle.
#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <span>
#include <unordered_map>
#include <vector>

namespace towbench::board {

using RegisterSet = std::array<std::uint32_t, 17>;     // r0 .. r15's place unused, CPSR
using FloatRegisters = std::array<std::uint64_t, 33>;  // d0 .. d31, FPSCR

class RegisterReader {
 public:
  RegisterReader() = default;
  RegisterReader(const RegisterReader&) = delete;
  RegisterReader& operator=(const RegisterReader&) = delete;
  virtual ~RegisterReader() = default;
  [[nodiscard]] virtual RegisterSet registers() const = 0;
  [[nodiscard]] virtual FloatRegisters float_registers() const = 0;
  // The youngest part of the stack: what a loop counts there is not in the image's own memory.
  [[nodiscard]] virtual std::span<const std::uint8_t> stack_top() const = 0;
};

class IdleDetector {
 public:
  // What a loop could change: writable memory of the image.
  void watch(std::vector<std::span<const std::uint8_t>> memory) { memory_ = std::move(memory); }

  // At the start of each block. True: the program is idle here.
  [[nodiscard]] bool at_block(std::uint32_t address, std::uint64_t disturbances,
                              const RegisterReader& reader) {
    if (disturbances == seen_ && address != head_ && steps_ < limit_) {
      ++steps_;
      return false;
    }
    return look(address, disturbances, reader);
  }
  // Something happened: the search starts over.
  void restart() noexcept { seen_ = ~0ULL; }

 private:
  enum class Standing : std::uint8_t { kUnknown, kIdle, kBusy };

  [[nodiscard]] bool look(std::uint32_t address, std::uint64_t disturbances,
                          const RegisterReader& reader);
  [[nodiscard]] bool confirm(std::uint32_t address, const RegisterReader& reader);
  [[nodiscard]] std::vector<std::uint8_t> copy_of_memory() const;
  [[nodiscard]] bool memory_is(const std::vector<std::uint8_t>& copy) const;

  std::vector<std::span<const std::uint8_t>> memory_;
  std::unordered_map<std::uint32_t, Standing> standing_;
  std::uint64_t seen_ = ~0ULL;
  std::uint32_t head_ = 0;
  std::uint32_t steps_ = 0;
  std::uint32_t limit_ = 0;
  std::uint32_t rounds_to_check_ = 0;
  std::uint32_t patience_ = 1;
  bool has_snapshot_ = false;
  bool confirming_ = false;
  RegisterSet snapshot_{};
  std::vector<std::uint8_t> stack_snapshot_;
  FloatRegisters float_snapshot_{};
  std::vector<std::uint8_t> memory_copy_;
};

}  // namespace towbench::board
