#include "protocol/cobs.h"

#include <algorithm>

#include <gtest/gtest.h>

#include "core/random.h"
#include "tests/protocol/byte_sinks.h"
#include "tests/protocol/golden.h"
#include "tests/protocol/recording_sink.h"

namespace towbench::protocol {
namespace {

std::vector<std::byte> stuffed(const std::vector<std::byte>& bytes) {
  std::vector<std::byte> out(bytes.size() + cobs_overhead(bytes.size()));
  out.resize(cobs_stuff(bytes, out));
  return out;
}

std::vector<std::byte> count_up(unsigned from, unsigned to) {
  std::vector<std::byte> bytes;
  for (unsigned i = from; i <= to; ++i) {
    bytes.push_back(static_cast<std::byte>(i));
  }
  return bytes;
}

std::vector<std::byte> joined(std::vector<std::byte> a, const std::vector<std::byte>& b) {
  a.insert(a.end(), b.begin(), b.end());
  return a;
}

// The examples of the Wikipedia article on COBS, which follow Cheshire and Baker (1999).
TEST(Cobs, StuffsThePublishedExamples) {
  const std::pair<const char*, const char*> examples[] = {
      {"00", "0101"},
      {"0000", "010101"},
      {"001100", "01021101"},
      {"11220033", "0311220233"},
      {"11223344", "0511223344"},
      {"11000000", "0211010101"},
  };
  for (const auto& [plain, expected] : examples) {
    const auto out = stuffed(bytes_of(plain));
    EXPECT_EQ(hex_of(out.data(), out.size()), expected);
  }
}

TEST(Cobs, StuffsLongRunsAsPublished) {
  const std::byte code_ff{0xff};
  const std::vector<std::byte> zero{std::byte{0}};
  EXPECT_EQ(stuffed(count_up(1, 254)), joined({code_ff}, count_up(1, 254)));
  EXPECT_EQ(stuffed(joined(zero, count_up(1, 254))),
            joined({std::byte{1}, code_ff}, count_up(1, 254)));
  EXPECT_EQ(stuffed(count_up(1, 255)),
            joined(joined({code_ff}, count_up(1, 254)), {std::byte{2}, std::byte{255}}));
  EXPECT_EQ(stuffed(joined(count_up(2, 255), zero)),
            joined(joined({code_ff}, count_up(2, 255)), {std::byte{1}, std::byte{1}}));
  EXPECT_EQ(stuffed(joined(count_up(3, 255), joined(zero, {std::byte{1}}))),
            joined(joined({std::byte{0xfe}}, count_up(3, 255)), {std::byte{2}, std::byte{1}}));
}

TEST(Cobs, UnstuffsWhatItStuffedWithoutAZeroAndWithinTheStatedOverhead) {
  core::Random random(41);
  for (std::size_t size = 1; size < 1200; ++size) {
    std::vector<std::byte> bytes(size);
    for (auto& byte : bytes) {
      const bool zero = random.bits() % (1 + size / 3) == 0;
      byte = zero ? std::byte{0} : static_cast<std::byte>(1 + random.bits() % 255);
    }
    auto out = stuffed(bytes);
    ASSERT_EQ(std::count(out.begin(), out.end(), std::byte{0}), 0);
    ASSERT_LE(out.size(), size + cobs_overhead(size));
    out.resize(cobs_unstuff(out));
    ASSERT_EQ(out, bytes);
  }
}

TEST(Cobs, RefusesBytesThatAreNotCobs) {
  for (const char* hex : {"00", "02", "0511", "0211 00", "ff0102"}) {
    auto bytes = bytes_of(hex);
    EXPECT_EQ(cobs_unstuff(bytes), 0U) << hex;
  }
}

TEST(Cobs, TakesZerosBetweenFramesForAnIdleLine) {
  KeepingByteSink out;
  CobsWriter writer(out);
  std::vector<std::byte> bytes(5);
  writer.on(Advance{1});
  bytes = joined(bytes, out.bytes);
  bytes = joined(bytes, std::vector<std::byte>(5));
  CobsReader reader;
  CountingSink sink;
  reader.feed(bytes, sink);
  EXPECT_EQ(sink.count, 1U);
  EXPECT_EQ(reader.counts().errors(), 0U);
}

TEST(Cobs, CountsAFrameThatNeverEndsOnceAndIsBackAtTheNextZero) {
  KeepingByteSink out;
  CobsWriter writer(out);
  writer.on(Advance{1});
  CobsReader reader;
  CountingSink sink;
  reader.feed(std::vector<std::byte>(100'000, std::byte{1}), sink);
  reader.feed(std::vector<std::byte>{std::byte{0}}, sink);
  reader.feed(out.bytes, sink);
  EXPECT_EQ(reader.counts().too_long, 1U);
  EXPECT_EQ(reader.counts().skipped_bytes, 100'000U);
  EXPECT_EQ(reader.counts().errors(), 1U);
  EXPECT_EQ(sink.count, 1U);
}

TEST(Cobs, NamesWhatItMet) {
  CobsReader reader;
  CountingSink sink;
  reader.feed(bytes_of("0511 00"), sink);
  EXPECT_EQ(reader.counts().malformed, 1U);
  reader.feed(bytes_of("0611 22 33 44 55 00"), sink);
  EXPECT_EQ(reader.counts().bad_crc, 1U);
  // Message 0x63 with its right checksum.
  std::vector<std::byte> body{std::byte{0x63}};
  const std::uint32_t crc = crc32c(body);
  for (unsigned i = 0; i < 4; ++i) {
    body.push_back(static_cast<std::byte>(crc >> (8 * i)));
  }
  reader.feed(joined(stuffed(body), {std::byte{0}}), sink);
  EXPECT_EQ(reader.counts().unknown, 1U);
  EXPECT_EQ(sink.count, 0U);
  EXPECT_EQ(reader.counts().errors(), 3U);
}

}  // namespace
}  // namespace towbench::protocol
