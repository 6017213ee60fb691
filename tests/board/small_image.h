// An ELF file around a few instructions, made by hand so that no cross compiler is needed.
#pragma once

#include <cstdint>
#include <span>
#include <string_view>
#include <vector>

namespace towbench::board {

inline constexpr std::uint32_t kSmallImageAddress = 0x8000'0000;

// Code at kSmallImageAddress, entered there, with one function symbol "start" over all of it.
inline std::vector<std::uint8_t> small_image(const std::vector<std::uint32_t>& code,
                                             std::uint32_t address = kSmallImageAddress) {
  std::vector<std::uint8_t> file;
  const auto half = [&](std::uint32_t v) {
    file.push_back(static_cast<std::uint8_t>(v));
    file.push_back(static_cast<std::uint8_t>(v >> 8U));
  };
  const auto word = [&](std::uint32_t v) {
    half(v);
    half(v >> 16U);
  };
  const auto size = static_cast<std::uint32_t>(4 * code.size());
  constexpr std::string_view kNames("\0start\0", 7);
  constexpr std::uint32_t kCode = 52 + 32;
  const std::uint32_t symbols = kCode + size;
  const std::uint32_t names = symbols + 32;
  const std::uint32_t sections = names + 8;
  for (const int b : {0x7F, 0x45, 0x4C, 0x46, 1, 1, 1, 0, 0, 0, 0, 0, 0, 0, 0, 0}) {
    file.push_back(static_cast<std::uint8_t>(b));
  }
  half(2);   // executable
  half(40);  // ARM
  word(1);
  word(address);
  word(52);
  word(sections);
  word(0x0500'0000);
  for (const std::uint32_t v : {52U, 32U, 1U, 40U, 3U, 0U}) {
    half(v);
  }
  for (const std::uint32_t v : {1U, kCode, address, address, size, size, 7U, 4U}) {
    word(v);
  }
  for (const std::uint32_t v : code) {
    word(v);
  }
  for (int i = 0; i < 4; ++i) {
    word(0);  // the null symbol
  }
  word(1);
  word(address);
  word(size);
  half(0x12);  // global function
  half(1);
  for (const char c : kNames) {
    file.push_back(static_cast<std::uint8_t>(c));
  }
  file.push_back(0);
  for (int i = 0; i < 10; ++i) {
    word(0);  // the null section
  }
  for (const std::uint32_t v : {0U, 2U, 0U, 0U, symbols, 32U, 2U, 1U, 4U, 16U}) {
    word(v);
  }
  for (const std::uint32_t v : {0U, 3U, 0U, 0U, names, 7U, 0U, 0U, 1U, 0U}) {
    word(v);
  }
  return file;
}

}  // namespace towbench::board
