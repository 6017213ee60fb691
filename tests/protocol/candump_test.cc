#include "protocol/carriers/candump.h"

#include <array>
#include <string>

#include <gtest/gtest.h>

#include "core/random.h"

namespace towbench::protocol {
namespace {

std::string written(const CandumpLine& line) {
  std::array<char, kMaxCandumpLine> text{};
  return std::string(write_candump(line, text));
}

// The example of can-utils' README and of its log format.
TEST(Candump, WritesAndReadsTheLogFormat) {
  const std::string text = "(1436509052.249713) vcan0 044#2A366C2BBA";
  const auto line = read_candump(text);
  ASSERT_TRUE(line.has_value());
  EXPECT_EQ(line->time_ns, 1'436'509'052'249'713'000);
  EXPECT_EQ(line->interface, "vcan0");
  EXPECT_EQ(line->frame, (CanFrame{0x044, 5, {0x2a, 0x36, 0x6c, 0x2b, 0xba}}));
  EXPECT_EQ(written(*line), text);
}

// cansend and candump of can-utils: ID##FLAGS and the data of an FD frame.
TEST(Candump, WritesAndReadsFdFrames) {
  const std::string text = "(1.000000) vcan0 1A0##1" + std::string(48, 'A');
  const auto line = read_candump(text);
  ASSERT_TRUE(line.has_value());
  EXPECT_TRUE(line->frame.is_fd);
  EXPECT_EQ(line->frame.size, 24U);
  EXPECT_EQ(line->frame.data[23], 0xaa);
  EXPECT_EQ(written(*line), text);
  EXPECT_FALSE(read_candump("(1.000000) vcan0 1A0##").has_value());
  EXPECT_FALSE(read_candump("(1.000000) vcan0 1A0##G00").has_value());
  EXPECT_FALSE(read_candump("(1.000000) vcan0 1A0##1" + std::string(18, '0')).has_value())
      << "no FD frame has nine bytes";
}

TEST(Candump, ReadsWhatComesBehindTheData) {
  EXPECT_EQ(read_candump("(0.000001) can0 7FF#00 R\r\n")->frame.size, 1U);
  EXPECT_EQ(read_candump("(0.000001) can0 000#\n")->frame.size, 0U);
  EXPECT_EQ(read_candump("(0.000001) can0 7ff#ab")->frame.data[0], 0xab) << "small letters too";
}

TEST(Candump, EveryFrameSurvivesTheRoundTrip) {
  core::Random random(1);
  for (int i = 0; i < 20'000; ++i) {
    CandumpLine line{
        .time_ns = static_cast<core::Nanoseconds>(random.bits() % 4'000'000'000'000'000) *
                   core::kNanosecondsPerMicrosecond,
        .interface = i % 2 == 0 ? "vcan0" : "averylongname15"};
    line.frame.id = static_cast<std::uint32_t>(random.bits() % 0x800);
    line.frame.size = static_cast<std::uint8_t>(random.bits() % 9);
    for (unsigned j = 0; j < line.frame.size; ++j) {
      line.frame.data[j] = static_cast<std::uint8_t>(random.bits());
    }
    const std::string text = written(line);
    const auto again = read_candump(text);
    ASSERT_TRUE(again.has_value()) << text;
    ASSERT_EQ(again->time_ns, line.time_ns);
    ASSERT_EQ(again->interface, line.interface);
    ASSERT_EQ(again->frame, line.frame);
  }
}

TEST(Candump, RefusesWhatIsNoDataFrame) {
  for (const char* text : {"",
                           "(",
                           "()",
                           "(1.000000)",
                           "(1.000000) can0",
                           "(1.000000) can0 ",
                           "(1.000000) can0 123",
                           "(1.000000) can0 123##0A",
                           "(1.000000) can0 123#R",
                           "(1.000000) can0 20000080#0000",
                           "(1.000000) can0 1234#00",
                           "(1.000000) can0 800#00",
                           "(1.000000) can0 -12#00",
                           "(1.000000) can0 123#0",
                           "(1.000000) can0 123#001122334455667788",
                           "(1.000000) can0 123#0G",
                           "(1.00000) can0 123#00",
                           "(1) can0 123#00",
                           "(-1.000000) can0 123#00",
                           "(1.000000)can0 123#00",
                           "1.000000 can0 123#00",
                           "(1.000000)  can0 123#00",
                           "(99999999999.000000) can0 123#00"}) {
    EXPECT_FALSE(read_candump(text).has_value()) << text;
  }
}

TEST(Candump, WritesNothingThatIsNoLine) {
  EXPECT_EQ(written({.time_ns = -1, .interface = "can0"}), "");
  EXPECT_EQ(written({.interface = ""}), "");
  EXPECT_EQ(written({.interface = "sixteencharacter"}), "");
  EXPECT_EQ(written({.interface = "two words"}), "");
  EXPECT_EQ(write_candump({.interface = "can0"}, {}), "");
}

TEST(Candump, NoBytesCrashTheReader) {
  core::Random random(8);
  const std::string good = "(1436509052.249713) vcan0 044#2A366C2BBA";
  for (int i = 0; i < 200'000; ++i) {
    std::string text = good;
    for (std::uint64_t hit = 1 + random.bits() % 4; hit > 0; --hit) {
      text[random.bits() % text.size()] = static_cast<char>(random.bits());
    }
    const auto line = read_candump(std::string_view(text).substr(0, random.bits() % text.size()));
    if (line) {
      ASSERT_LE(line->frame.id, kMaxStandardId);
      ASSERT_LE(line->frame.size, line->frame.is_fd ? kCanFdDataSize : kCanDataSize);
    }
  }
}

}  // namespace
}  // namespace towbench::protocol
