#include "board/kept_registers.h"

#include <algorithm>
#include <utility>

#include <fmt/format.h>

namespace towbench::board {

KeptRegisters::KeptRegisters(std::string name, std::uint32_t size, Bus& bus)
    : RegisterBlock(std::move(name), size, bus), uses_(size / 4, Use::kNone) {}

void KeptRegisters::reset() {
  RegisterBlock::reset();
  std::fill(uses_.begin(), uses_.end(), Use::kNone);
}

std::uint32_t KeptRegisters::read_word(std::uint32_t offset, std::uint32_t /*lanes*/) {
  auto& use = uses_[offset / 4];
  if (use == Use::kReadOnce && bus().doubt.empty()) {
    bus().doubt = fmt::format("register 0x{:x} of {}", offset, name());
  }
  if (use == Use::kNone) {
    note(fmt::format("{}: register 0x{:x} is read, not modelled", name(), offset));
    use = Use::kReadOnce;
  }
  return stored(offset);
}

void KeptRegisters::write_word(std::uint32_t offset, std::uint32_t value, std::uint32_t lanes) {
  note(fmt::format("{}: register 0x{:x} is kept, not modelled", name(), offset));
  uses_[offset / 4] = Use::kWritten;
  keep(offset, value, lanes);
}

}  // namespace towbench::board
