#include "protocol/crc.h"

#include <array>
#include <cstring>
#include <string_view>
#include <vector>

#include <gtest/gtest.h>

#include "core/random.h"

namespace towbench::protocol {
namespace {

std::span<const std::byte> text_bytes(std::string_view text) {
  return std::as_bytes(std::span(text.data(), text.size()));
}

// The check value of CRC-32/ISCSI in the catalogue of parametrised CRC algorithms.
TEST(Crc, MatchesTheCatalogueCheckValue) {
  EXPECT_EQ(crc32c(text_bytes("123456789")), 0xe3069283U);
  EXPECT_EQ(crc32c_by_table(text_bytes("123456789")), 0xe3069283U);
  EXPECT_EQ(crc32c({}), 0U);
}

// RFC 3720, appendix B.4.
TEST(Crc, MatchesTheIscsiExamples) {
  std::array<std::byte, 32> bytes{};
  EXPECT_EQ(crc32c(bytes), 0x8a9136aaU);
  bytes.fill(std::byte{0xff});
  EXPECT_EQ(crc32c(bytes), 0x62a8ab43U);
  for (std::size_t i = 0; i < bytes.size(); ++i) {
    bytes[i] = static_cast<std::byte>(i);
  }
  EXPECT_EQ(crc32c(bytes), 0x46dd794eU);
}

TEST(Crc, InstructionAndTableAgreeAtEveryLengthAndAlignment) {
  core::Random random(7);
  std::vector<std::byte> bytes(300);
  for (auto& byte : bytes) {
    byte = static_cast<std::byte>(random.bits());
  }
  for (std::size_t start = 0; start < 9; ++start) {
    for (std::size_t size = 0; start + size <= bytes.size(); ++size) {
      const auto part = std::span<const std::byte>(bytes).subspan(start, size);
      ASSERT_EQ(crc32c(part), crc32c_by_table(part));
    }
  }
}

TEST(Crc, SeesEveryFlippedBit) {
  std::vector<std::byte> bytes(64);
  const std::uint32_t intact = crc32c(bytes);
  for (std::size_t bit = 0; bit < 8 * bytes.size(); ++bit) {
    bytes[bit / 8] ^= std::byte{1} << (bit % 8);
    EXPECT_NE(crc32c(bytes), intact);
    bytes[bit / 8] ^= std::byte{1} << (bit % 8);
  }
}

}  // namespace
}  // namespace towbench::protocol
