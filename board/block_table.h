// The basic blocks that a program has run, and how often.
//
// Asked at every block, a thousand times in a millisecond of control: a block remembers which one
// followed it last, and the records lie in the order of their first run, so that the answer is
// nearly always the one next to the last.
#pragma once

#include <cstdint>
#include <vector>

namespace towbench::board {

struct Block {
  std::uint32_t address = 0;
  std::uint32_t size = 0;
  std::uint32_t instructions = 0;
  int function = -1;              // index of a symbol; -1: none
  std::uint32_t followed_by = 0;  // index of a record
  std::uint64_t runs = 0;         // all of them
  std::uint64_t runs_in_interrupts = 0;
};

class BlockTable {
 public:
  BlockTable() { clear(); }

  // Null when it has never run. A block that has changed its size is another block.
  [[nodiscard]] Block* find(std::uint32_t address, std::uint32_t size) noexcept {
    const std::uint32_t guess = blocks_[last_].followed_by;
    if (blocks_[guess].address == address && blocks_[guess].size == size) {
      last_ = guess;
      return &blocks_[guess];
    }
    return look_up(address, size);
  }
  // Valid until the next add().
  Block& add(const Block& block);

  [[nodiscard]] const std::vector<Block>& blocks() const noexcept { return blocks_; }
  void clear();

 private:
  [[nodiscard]] Block* look_up(std::uint32_t address, std::uint32_t size) noexcept;
  [[nodiscard]] std::size_t slot_of(std::uint32_t address, std::uint32_t size) const noexcept;
  void grow();

  std::vector<Block> blocks_;         // the first is no block
  std::vector<std::uint32_t> slots_;  // a power of two of indices, by hash; 0: free
  std::uint32_t last_ = 0;
};

}  // namespace towbench::board
