#include "board/block_table.h"

namespace towbench::board {
namespace {

constexpr std::size_t kFirstSlots = 1U << 12U;

}  // namespace

void BlockTable::clear() {
  blocks_.assign(1, Block{});
  slots_.assign(kFirstSlots, 0);
  last_ = 0;
}

// Where the block's index is, or would be.
std::size_t BlockTable::slot_of(std::uint32_t address, std::uint32_t size) const noexcept {
  constexpr std::uint32_t kGoldenRatio = 0x9E37'79B1;  // Knuth's multiplicative hash
  constexpr unsigned kWordBits = 32;
  const std::size_t mask = slots_.size() - 1;
  const std::uint64_t spread = std::uint64_t{address >> 1U} * kGoldenRatio;
  std::size_t slot = static_cast<std::size_t>((spread >> 8U) ^ (spread >> kWordBits)) & mask;
  while (slots_[slot] != 0) {
    const Block& block = blocks_[slots_[slot]];
    if (block.address == address && block.size == size) {
      break;
    }
    slot = (slot + 1) & mask;
  }
  return slot;
}

Block* BlockTable::look_up(std::uint32_t address, std::uint32_t size) noexcept {
  const std::uint32_t index = slots_[slot_of(address, size)];
  if (index == 0) {
    return nullptr;
  }
  blocks_[last_].followed_by = index;
  last_ = index;
  return &blocks_[index];
}

Block& BlockTable::add(const Block& block) {
  if (2 * blocks_.size() > slots_.size()) {
    grow();
  }
  const auto index = static_cast<std::uint32_t>(blocks_.size());
  blocks_.push_back(block);
  slots_[slot_of(block.address, block.size)] = index;
  blocks_[last_].followed_by = index;
  last_ = index;
  return blocks_.back();
}

void BlockTable::grow() {
  slots_.assign(2 * slots_.size(), 0);
  for (std::size_t i = 1; i < blocks_.size(); ++i) {
    slots_[slot_of(blocks_[i].address, blocks_[i].size)] = static_cast<std::uint32_t>(i);
  }
}

}  // namespace towbench::board
