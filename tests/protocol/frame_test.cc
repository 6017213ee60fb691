#include "protocol/frame.h"

#include <gtest/gtest.h>

#include "tests/protocol/byte_sinks.h"
#include "tests/protocol/golden.h"
#include "tests/protocol/recording_sink.h"

namespace towbench::protocol {
namespace {

// CRC-32C of 0900 0a 0807060504030201, computed with an independent bitwise implementation.
std::uint32_t bitwise_crc(const std::vector<std::byte>& bytes) {
  std::uint32_t crc = 0xffffffffU;
  for (const std::byte byte : bytes) {
    for (unsigned bit = 0; bit < 8; ++bit) {
      const std::uint32_t in = std::to_integer<std::uint32_t>(byte >> bit) & 1U;
      const std::uint32_t out = crc & 1U;
      crc = (crc >> 1U) ^ (in != out ? 0x82f63b78U : 0U);
    }
  }
  return ~crc;
}

TEST(Frame, IsLengthPayloadAndChecksum) {
  for (const Golden& golden : golden_messages()) {
    KeepingByteSink out;
    FrameWriter writer(out, FlushAt::kRequest);
    golden.send(writer);
    ASSERT_TRUE(writer.flush().has_value());
    auto expected = bytes_of(golden.payload_hex);
    const auto size = static_cast<unsigned>(expected.size());
    expected.insert(expected.begin(),
                    {static_cast<std::byte>(size & 255U), static_cast<std::byte>(size >> 8U)});
    const std::uint32_t crc = bitwise_crc(expected);
    for (unsigned i = 0; i < 4; ++i) {
      expected.push_back(static_cast<std::byte>(crc >> (8 * i)));
    }
    EXPECT_EQ(hex_of(out.bytes.data(), out.bytes.size()), hex_of(expected.data(), expected.size()))
        << golden.name;
  }
}

TEST(Frame, NamesWhatItMet) {
  KeepingByteSink out;
  FrameWriter writer(out);
  writer.on(Advance{1});
  const auto good = out.bytes;
  struct Case {
    std::size_t at;
    std::byte value;
    std::uint64_t LinkCounts::*count;
  };
  const Case cases[] = {{1, std::byte{0xff}, &LinkCounts::too_long},
                        {0, std::byte{8}, &LinkCounts::malformed},
                        {2, std::byte{77}, &LinkCounts::malformed},
                        {5, std::byte{1}, &LinkCounts::bad_crc},
                        {good.size() - 1, good.back() ^ std::byte{1}, &LinkCounts::bad_crc}};
  for (const Case& c : cases) {
    auto bytes = good;
    bytes[c.at] = c.value;
    bytes.insert(bytes.end(), good.begin(), good.end());
    FrameReader reader;
    CountingSink sink;
    reader.feed(bytes, sink);
    EXPECT_EQ(reader.counts().*c.count, 1U) << "byte " << c.at;
    EXPECT_EQ(reader.counts().errors(), 1U) << "byte " << c.at;
    EXPECT_EQ(reader.counts().skipped_bytes, good.size()) << "byte " << c.at;
    EXPECT_EQ(sink.count, 1U);
  }
}

}  // namespace
}  // namespace towbench::protocol
