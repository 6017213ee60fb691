#include "protocol/crc.h"

#include <array>

#include "protocol/wire.h"

namespace towbench::protocol {
namespace {

constexpr std::uint32_t kReflectedPolynomial = 0x82f63b78U;
constexpr std::size_t kSlices = 8;
using Table = std::array<std::array<std::uint32_t, 256>, kSlices>;

// Slicing by eight (Kounavis and Berry, "A Systematic Approach to Building High Performance
// Software-Based CRC Generators", ISCC 2005): slice k holds a byte followed by k zero bytes.
constexpr Table make_table() noexcept {
  Table table{};
  for (std::uint32_t byte = 0; byte < 256; ++byte) {
    std::uint32_t crc = byte;
    for (int bit = 0; bit < 8; ++bit) {
      crc = (crc >> 1U) ^ ((crc & 1U) != 0 ? kReflectedPolynomial : 0U);
    }
    table[0][byte] = crc;
  }
  for (std::size_t k = 1; k < kSlices; ++k) {
    for (std::size_t byte = 0; byte < 256; ++byte) {
      const std::uint32_t before = table[k - 1][byte];
      table[k][byte] = (before >> 8U) ^ table[0][before & 0xffU];
    }
  }
  return table;
}

constexpr Table kTable = make_table();

}  // namespace

std::uint32_t crc32c(std::span<const std::byte> bytes) noexcept {
  std::uint32_t crc = 0xffffffffU;
  const std::byte* at = bytes.data();
  std::size_t left = bytes.size();
  for (; left >= kSlices; left -= kSlices, at += kSlices) {
    const std::uint32_t low = crc ^ load_little_endian<std::uint32_t>(at);
    const auto high = load_little_endian<std::uint32_t>(at + 4);
    crc = kTable[7][low & 0xffU] ^ kTable[6][(low >> 8U) & 0xffU] ^
          kTable[5][(low >> 16U) & 0xffU] ^ kTable[4][low >> 24U] ^ kTable[3][high & 0xffU] ^
          kTable[2][(high >> 8U) & 0xffU] ^ kTable[1][(high >> 16U) & 0xffU] ^
          kTable[0][high >> 24U];
  }
  for (; left > 0; --left, ++at) {
    crc = (crc >> 8U) ^ kTable[0][(crc ^ static_cast<std::uint32_t>(*at)) & 0xffU];
  }
  return crc ^ 0xffffffffU;
}

}  // namespace towbench::protocol
