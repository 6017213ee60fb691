// Two UARTs that disagree: what gets through follows from when the bits are sampled.
#include "harness/link/uart_line.h"

#include <array>
#include <vector>

#include <gtest/gtest.h>

namespace towbench::harness {
namespace {

std::vector<std::byte> every_byte_twice() {
  std::vector<std::byte> bytes;
  for (unsigned i = 0; i < 512; ++i) {
    bytes.push_back(static_cast<std::byte>(i & 0xffU));
  }
  return bytes;
}

std::vector<std::byte> received(std::span<const std::byte> sent, double ratio) {
  std::vector<std::byte> into(8192);
  into.resize(over_uart(sent, ratio, into));
  return into;
}

TEST(UartLine, CarriesEveryByteBetweenEqualClocks) {
  const auto sent = every_byte_twice();
  EXPECT_EQ(received(sent, 1.0), sent);
}

// The middle of the stop bit is 9.5 bits after the edge of the start bit: a receiver that is too
// fast meets the last data bit there from 9.5 / 9 on, one that is too slow the next start bit from
// 9.5 / 10 on.
TEST(UartLine, BearsAsMuchAsHalfABitInNineAndAHalf) {
  const auto sent = every_byte_twice();
  for (const double ratio : {0.951, 0.97, 1.03, 1.055}) {
    EXPECT_EQ(received(sent, ratio), sent) << ratio;
  }
  for (const double ratio : {0.949, 1.057, 0.9, 1.1}) {
    EXPECT_NE(received(sent, ratio), sent) << ratio;
  }
}

// 0xf0 at half the rate: seen from its start bit on, by hand. Sent bits are 0 | 0000 1111 | 1 and
// then idle; sampled at 3, 5, 7, .. 17 and 19: 0, 1, 1, 1, 1, 1, 1, 1 and 1.
TEST(UartLine, SamplesWhatIsThereAtHalfTheRate) {
  const std::array sent{std::byte{0xf0}};
  EXPECT_EQ(received(sent, 0.5), std::vector<std::byte>{std::byte{0xfe}});
}

// All zeros at an eighth of the rate: the stop bit is 76 bits behind the start bit, in the middle
// of a later byte's zeros.
TEST(UartLine, DropsWhatHasNoStopBit) {
  const std::vector<std::byte> sent(32, std::byte{0});
  EXPECT_TRUE(received(std::span(sent).first(8), 0.125).empty());
}

}  // namespace
}  // namespace towbench::harness
