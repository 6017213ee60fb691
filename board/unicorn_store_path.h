// A faster way for Unicorn 2.0's stores; see docs/decisions/0014-virtual-board.md.
#pragma once

#include <cstdint>
#include <vector>

namespace towbench::board {

// Which pages of the memory that was mapped first hold code, so that the others need not be watched
// for it. Active on the thread between begin() and end().
class StorePath {
 public:
  // Of the first memory mapped; whole pages.
  StorePath(std::uint32_t address, std::uint32_t size)
      : address_(address), is_code_(size / kPage, false) {}
  StorePath(const StorePath&) = delete;
  StorePath& operator=(const StorePath&) = delete;
  ~StorePath() { end(); }

  void begin() noexcept;
  void end() noexcept;

  // A block of code runs there for the first time.
  void code_at(std::uint32_t address, std::uint32_t size);

  // The library's side: a store went the slow way to this offset of the memory. True when later
  // ones to its page need not.
  [[nodiscard]] bool may_free(std::uint64_t offset) noexcept;
  [[nodiscard]] std::uint32_t address() const noexcept { return address_; }
  void attach(void* cpu) noexcept { cpu_ = cpu; }
  [[nodiscard]] void* cpu() const noexcept { return cpu_; }

 private:
  static constexpr std::uint32_t kPage = 4096;

  std::uint32_t address_;
  std::vector<bool> is_code_;
  std::vector<bool> is_free_ = std::vector<bool>(is_code_.size(), false);
  void* cpu_ = nullptr;
};

}  // namespace towbench::board
