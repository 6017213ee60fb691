#include "protocol/crc.h"

#include <array>

#if defined(__x86_64__)
#include <nmmintrin.h>
#endif

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

std::uint32_t crc_by_table(std::span<const std::byte> bytes) noexcept {
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

#if defined(__x86_64__)
// The processor's own CRC-32C: the same sum, about four times as fast.
[[gnu::target("sse4.2")]] std::uint32_t crc_by_instruction(
    std::span<const std::byte> bytes) noexcept {
  std::uint64_t crc = 0xffffffffU;
  const std::byte* at = bytes.data();
  std::size_t left = bytes.size();
  for (; left >= sizeof(std::uint64_t); left -= sizeof(std::uint64_t)) {
    crc = _mm_crc32_u64(crc, load_little_endian<std::uint64_t>(at));
    at += sizeof(std::uint64_t);
  }
  auto narrow = static_cast<std::uint32_t>(crc);
  for (; left > 0; --left, ++at) {
    narrow = _mm_crc32_u8(narrow, std::to_integer<std::uint8_t>(*at));
  }
  return narrow ^ 0xffffffffU;
}

const bool kHasInstruction = __builtin_cpu_supports("sse4.2") != 0;
#endif

}  // namespace

std::uint32_t crc32c(std::span<const std::byte> bytes) noexcept {
#if defined(__x86_64__)
  if (kHasInstruction) {
    return crc_by_instruction(bytes);
  }
#endif
  return crc_by_table(bytes);
}

std::uint32_t crc32c_by_table(std::span<const std::byte> bytes) noexcept {
  return crc_by_table(bytes);
}

}  // namespace towbench::protocol
