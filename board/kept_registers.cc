#include "board/kept_registers.h"

#include <algorithm>
#include <array>
#include <string_view>
#include <utility>

#include <fmt/format.h>

namespace towbench::board {
namespace {

// Registers that the hardware changes: samples, bytes that have come, states, times. Whatever was
// written there, what is read is not computed. AM335x TRM: 12.5, 15.3.4, 19.5, 20.2.5, 20.3.5,
// 21.4, 24.4.
struct Volatile {
  std::string_view block;  // begins so
  std::vector<std::uint32_t> offsets;
};
const std::array kVolatile{
    Volatile{"adc", {0x24, 0x28, 0x44, 0xE4, 0xF0, 0x100, 0x200}},
    Volatile{"ecap", {0x00, 0x08, 0x0C, 0x10, 0x14}},
    Volatile{"uart", {0x00, 0x08, 0x14, 0x18}},
    Volatile{"dmtimer1", {0x3C}},
    Volatile{"rtc", {0x00, 0x04, 0x08, 0x0C, 0x10, 0x14, 0x18}},
    Volatile{"i2c", {0x24, 0x28, 0x98, 0x9C}},
    Volatile{"spi", {0x118, 0x130, 0x13C, 0x144, 0x150}},
};

std::vector<std::uint32_t> volatile_registers_of(std::string_view block) {
  const auto found = std::find_if(kVolatile.begin(), kVolatile.end(), [&](const Volatile& each) {
    return block.starts_with(each.block);
  });
  return found == kVolatile.end() ? std::vector<std::uint32_t>{} : found->offsets;
}

}  // namespace

KeptRegisters::KeptRegisters(std::string name, std::uint32_t size, Bus& bus)
    : RegisterBlock(std::move(name), size, bus), uses_(size / 4) {
  forget();
}

void KeptRegisters::reset() {
  RegisterBlock::reset();
  forget();
}

void KeptRegisters::forget() {
  std::fill(uses_.begin(), uses_.end(), Use::kNone);
  for (const auto offset : volatile_registers_of(name())) {
    uses_[offset / 4] = Use::kVolatile;
  }
}

std::uint32_t KeptRegisters::read_word(std::uint32_t offset, std::uint32_t /*lanes*/) {
  auto& use = uses_[offset / 4];
  const bool decides = use == Use::kReadOnce || use == Use::kVolatile;
  if (decides && bus().doubt.empty()) {
    bus().doubt = fmt::format("register 0x{:x} of {}", offset, name());
  }
  if (use == Use::kNone || use == Use::kVolatile) {
    note(fmt::format("{}: register 0x{:x} is read, not modelled", name(), offset));
  }
  use = use == Use::kNone ? Use::kReadOnce : use;
  return stored(offset);
}

void KeptRegisters::write_word(std::uint32_t offset, std::uint32_t value, std::uint32_t lanes) {
  note(fmt::format("{}: register 0x{:x} is kept, not modelled", name(), offset));
  auto& use = uses_[offset / 4];
  use = use == Use::kVolatile ? use : Use::kWritten;
  keep(offset, value, lanes);
}

}  // namespace towbench::board
