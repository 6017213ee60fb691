// Fixed-size little-endian values in bytes. The caller has checked that they fit.
#pragma once

#include <bit>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <type_traits>

namespace towbench::protocol {

// The unsigned integer that carries a T: itself for integers, the underlying type of an enum, the
// bit pattern of a float.
template <std::size_t Size>
struct UnsignedOfSize;
template <>
struct UnsignedOfSize<1> {
  using type = std::uint8_t;
};
template <>
struct UnsignedOfSize<2> {
  using type = std::uint16_t;
};
template <>
struct UnsignedOfSize<4> {
  using type = std::uint32_t;
};
template <>
struct UnsignedOfSize<8> {
  using type = std::uint64_t;
};
template <typename T>
using WireWord = typename UnsignedOfSize<sizeof(T)>::type;

// Its own inverse; the identity on a little-endian machine.
template <typename Word>
[[nodiscard]] constexpr Word to_or_from_little_endian(Word word) noexcept {
  if constexpr (std::endian::native == std::endian::little || sizeof(Word) == 1) {
    return word;
  } else {
    Word swapped = 0;
    for (std::size_t i = 0; i < sizeof(Word); ++i) {
      swapped = static_cast<Word>((swapped << 8U) | ((word >> (8U * i)) & 0xffU));
    }
    return swapped;
  }
}

template <typename T>
void store_little_endian(std::byte* to, T value) noexcept {
  static_assert(std::is_arithmetic_v<T> || std::is_enum_v<T>);
  const auto word = to_or_from_little_endian(std::bit_cast<WireWord<T>>(value));
  std::memcpy(to, &word, sizeof(word));
}

// Not for bool: a byte other than 0 or 1 is no bool.
template <typename T>
[[nodiscard]] T load_little_endian(const std::byte* from) noexcept {
  static_assert((std::is_arithmetic_v<T> || std::is_enum_v<T>)&&!std::is_same_v<T, bool>);
  WireWord<T> word;
  std::memcpy(&word, from, sizeof(word));
  return std::bit_cast<T>(to_or_from_little_endian(word));
}

}  // namespace towbench::protocol
