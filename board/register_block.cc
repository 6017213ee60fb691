#include "board/register_block.h"

#include <algorithm>
#include <utility>

#include <fmt/format.h>

namespace towbench::board {
namespace {

constexpr std::uint32_t lanes_of(unsigned shift, unsigned bytes) noexcept {
  const std::uint32_t ones = bytes >= 4 ? 0xFFFF'FFFFU : (1U << (8 * bytes)) - 1U;
  return ones << shift;
}

}  // namespace

RegisterBlock::RegisterBlock(std::string name, std::uint32_t size, Bus& bus)
    : name_(std::move(name)), size_(size), bus_(bus), words_(size / 4, 0) {}

std::uint32_t RegisterBlock::load(std::uint32_t offset, unsigned bytes) {
  const unsigned within = offset % 4;
  if (within + bytes > 4) {
    const unsigned first = 4 - within;
    return load(offset, first) | (load(offset + first, bytes - first) << (8 * first));
  }
  const std::uint32_t lanes = lanes_of(8 * within, bytes);
  return (read_word(offset - within, lanes) & lanes) >> (8 * within);
}

void RegisterBlock::store(std::uint32_t offset, unsigned bytes, std::uint32_t value) {
  const unsigned within = offset % 4;
  if (within + bytes > 4) {
    const unsigned first = 4 - within;
    store(offset, first, value);
    store(offset + first, bytes - first, value >> (8 * first));
    return;
  }
  bus_.disturb();
  const std::uint32_t lanes = lanes_of(8 * within, bytes);
  write_word(offset - within, (value << (8 * within)) & lanes, lanes);
}

void RegisterBlock::reset() {
  std::fill(words_.begin(), words_.end(), 0U);
}

std::uint32_t RegisterBlock::read_word(std::uint32_t offset, std::uint32_t /*lanes*/) {
  return stored(offset);
}

void RegisterBlock::write_word(std::uint32_t offset, std::uint32_t value, std::uint32_t lanes) {
  note(fmt::format("{}: register 0x{:x} is kept, not modelled", name_, offset));
  keep(offset, value, lanes);
}

void RegisterBlock::keep(std::uint32_t offset, std::uint32_t value, std::uint32_t lanes) {
  stored(offset) = (stored(offset) & ~lanes) | (value & lanes);
}

void RegisterBlock::note(const std::string& text) {
  if (std::find(bus_.notes.begin(), bus_.notes.end(), text) == bus_.notes.end()) {
    bus_.notes.push_back(text);
  }
}

}  // namespace towbench::board
