#include "protocol/codec.h"

#include <algorithm>
#include <array>
#include <bit>
#include <limits>

#include <gtest/gtest.h>

#include "core/random.h"
#include "protocol/frame.h"
#include "protocol/wire.h"
#include "tests/protocol/any_message.h"
#include "tests/protocol/golden.h"
#include "tests/protocol/recording_sink.h"
#include "tests/support/allocation_guard.h"

namespace towbench::protocol {
namespace {

using core::ErrorCode;

// Encodes whatever it is sent.
class EncodingSink final : public EachMessage<EncodingSink> {
 public:
  template <typename Message>
  void handle(const Message& message) noexcept {
    bytes.resize(kMaxPayloadSize);
    bytes.resize(encode(message, bytes));
    stated_size = encoded_size(message);
    for (std::size_t room = 0; room < std::min<std::size_t>(bytes.size(), 64); ++room) {
      std::array<std::byte, 64> small;
      refused_when_small &= encode(message, std::span(small).first(room)) == 0;
    }
  }
  std::vector<std::byte> bytes;
  std::size_t stated_size = 0;
  bool refused_when_small = true;
};

std::vector<std::byte> encoded(void (*send)(MessageSink&)) {
  EncodingSink sink;
  send(sink);
  return sink.bytes;
}

ErrorCode decode_error(std::span<const std::byte> payload) {
  static Decoder decoder;
  CountingSink sink;
  const core::Status status = decoder.decode(payload, sink);
  EXPECT_EQ(sink.count, status.has_value() ? 1U : 0U);
  return status.has_value() ? ErrorCode::kNone : status.error();
}

// Decodes `golden` with the bytes at `offset` overwritten.
ErrorCode decode_error_with(const std::string& name, std::size_t offset, const std::string& hex) {
  for (const Golden& golden : golden_messages()) {
    if (golden.name == name) {
      auto payload = bytes_of(golden.payload_hex);
      const auto patch = bytes_of(hex);
      std::copy(patch.begin(), patch.end(), payload.begin() + static_cast<std::ptrdiff_t>(offset));
      return decode_error(payload);
    }
  }
  return ErrorCode::kMessageUnknown;
}

TEST(Codec, WritesTheExactBytesOfEveryMessage) {
  EXPECT_EQ(golden_messages().size(), 17U);
  for (const Golden& golden : golden_messages()) {
    const auto expected = bytes_of(golden.payload_hex);
    const auto actual = encoded(golden.send);
    EXPECT_EQ(hex_of(actual.data(), actual.size()), hex_of(expected.data(), expected.size()))
        << golden.name;
  }
}

TEST(Codec, ReadsTheExactBytesOfEveryMessage) {
  Decoder decoder;
  for (const Golden& golden : golden_messages()) {
    RecordingSink expected;
    golden.send(expected);
    RecordingSink actual;
    EXPECT_TRUE(decoder.decode(bytes_of(golden.payload_hex), actual).has_value()) << golden.name;
    EXPECT_EQ(actual.texts, expected.texts);
  }
}

TEST(Codec, EveryMessageSurvivesTheRoundTrip) {
  Decoder decoder;
  for (unsigned kind = 0; kind < AnyMessage::kKinds; ++kind) {
    for (std::uint64_t seed = 0; seed < 300; ++seed) {
      RecordingSink sent;
      AnyMessage(seed).send_to(sent, kind);
      EncodingSink encoding;
      AnyMessage(seed).send_to(encoding, kind);
      RecordingSink received;
      ASSERT_TRUE(decoder.decode(encoding.bytes, received).has_value()) << sent.texts.front();
      ASSERT_EQ(received.texts, sent.texts);
      ASSERT_EQ(encoding.bytes.size(), encoding.stated_size);
      ASSERT_TRUE(is_plausible(encoding.bytes[0], encoding.bytes.size()));
    }
  }
}

TEST(Codec, TakesNoHeap) {
  std::array<std::byte, LengthFraming::kMaxFrameSize> bytes;
  FrameReader reader;
  CountingSink sink;
  EncoderEdges edges;
  edges.end_ns = kMaxEdgesPerMessage;
  while (edges.edges.push_back(EncoderEdge(1, EncoderLine::kB))) {
  }
  {
    const tests::AllocationGuard guard;
    for (int i = 0; i < 3; ++i) {
      const std::size_t size = LengthFraming::append(edges, bytes);
      reader.feed(std::span<const std::byte>(bytes).first(size / 2), sink);
      reader.feed(std::span<const std::byte>(bytes).first(size).subspan(size / 2), sink);
    }
  }
  EXPECT_EQ(sink.count, 3U);
}

TEST(Codec, WritesNothingWhereThereIsNoRoom) {
  EncodingSink sink;
  for (const Golden& golden : golden_messages()) {
    golden.send(sink);
    EXPECT_TRUE(sink.refused_when_small) << golden.name;
  }
}

TEST(Codec, RefusesEveryOtherLength) {
  for (const Golden& golden : golden_messages()) {
    auto payload = bytes_of(golden.payload_hex);
    for (std::size_t size = 0; size < payload.size(); ++size) {
      EXPECT_NE(decode_error(std::span(payload).first(size)), ErrorCode::kNone) << golden.name;
    }
    payload.push_back(std::byte{0});
    EXPECT_EQ(decode_error(payload), ErrorCode::kMessageBadField) << golden.name;
  }
}

TEST(Codec, RefusesUnknownMessages) {
  for (const unsigned id : {0U, 18U, 19U, 127U, 255U}) {
    std::array<std::byte, 32> payload{static_cast<std::byte>(id)};
    EXPECT_EQ(decode_error(payload), ErrorCode::kMessageUnknown) << id;
    EXPECT_FALSE(is_plausible(payload[0], payload.size()));
  }
  EXPECT_EQ(decode_error({}), ErrorCode::kFrameTruncated);
}

TEST(Codec, RefusesEveryFieldOutOfItsRange) {
  const auto bad = ErrorCode::kMessageBadField;
  EXPECT_EQ(decode_error_with("Hello", 3, "03"), bad) << "role";
  EXPECT_EQ(decode_error_with("Hello", 4, "40"), bad) << "an axis that is none";
  EXPECT_EQ(decode_error_with("HelloReply", 25, "0100"), bad) << "error number 1";
  EXPECT_EQ(decode_error_with("PwmDuty", 1, "06"), bad) << "axis";
  EXPECT_EQ(decode_error_with("PwmDuty", 2, "02"), bad) << "enable neither 0 nor 1";
  EXPECT_EQ(decode_error_with("PwmDuty", 3, "8913"), bad) << "channel A beyond the period";
  EXPECT_EQ(decode_error_with("PwmDuty", 5, "8913"), bad) << "channel B beyond the period";
  EXPECT_EQ(decode_error_with("PwmDuty", 3, "00000000 0000"), bad) << "period 0";
  EXPECT_EQ(decode_error_with("EncoderEdges", 1, "ff"), bad) << "axis";
  EXPECT_EQ(decode_error_with("EncoderEdges", 2, "08"), bad) << "levels";
  EXPECT_EQ(decode_error_with("EncoderEdges", 3, "00000000000000ff"), bad) << "negative start";
  EXPECT_EQ(decode_error_with("EncoderEdges", 11, "0000000000000000"), bad) << "end before start";
  EXPECT_EQ(decode_error_with("EncoderEdges", 23, "0400"), bad) << "more edges than bytes";
  EXPECT_EQ(decode_error_with("EncoderEdges", 23, "0200"), bad) << "fewer edges than bytes";
  EXPECT_EQ(decode_error_with("EncoderEdges", 25, "010000c0"), bad) << "line 3";
  EXPECT_EQ(decode_error_with("EncoderEdges", 33, "ffffffbf"), bad) << "edge beyond the end";
  EXPECT_EQ(decode_error_with("EncoderReport", 2, "08"), bad) << "levels";
  EXPECT_EQ(decode_error_with("EncoderReport", 15, "0907060504030201"), bad)
      << "last edge after the interval";
  EXPECT_EQ(decode_error_with("DigitalInputs", 1, "00004000"), bad) << "line 22";
  EXPECT_EQ(decode_error_with("DigitalInputs", 1, "00002000"), ErrorCode::kNone) << "line 21";
  EXPECT_EQ(decode_error_with("DigitalOutputs", 1, "0010"), bad) << "line 12";
  EXPECT_EQ(decode_error_with("DigitalOutputs", 1, "0008"), ErrorCode::kNone) << "line 11";
  EXPECT_EQ(decode_error_with("ForceSample", 9, "0000c07f"), bad) << "NaN";
  EXPECT_EQ(decode_error_with("ForceSample", 29, "000080ff"), bad) << "minus infinity";
  EXPECT_EQ(decode_error_with("CurrentSample", 10, "0000807f"), bad) << "infinity";
  EXPECT_EQ(decode_error_with("Fault", 1, "ffff"), bad) << "error number 65535";
  EXPECT_EQ(decode_error_with("Reference", 1, "06"), bad) << "axis 6";
  EXPECT_EQ(decode_error_with("Reference", 10, "0000c07f"), bad) << "NaN";
  EXPECT_EQ(decode_error_with("AbsoluteCount", 1, "06"), bad) << "axis 6";
  EXPECT_EQ(decode_error_with("AbsoluteCount", 2, "0000000000000080"), bad) << "negative time";
  for (const char* name : {"Advance", "Advanced", "Heartbeat", "Bye", "Reset"}) {
    EXPECT_EQ(decode_error_with(name, 1, "0000000000000080"), bad) << name << ": negative time";
  }
}

TEST(Codec, ReadsTheGreetingOfALaterVersionWhateverItAppends) {
  for (const char* name : {"Hello", "HelloReply"}) {
    for (const Golden& golden : golden_messages()) {
      if (golden.name == name) {
        auto payload = bytes_of(golden.payload_hex);
        payload[1] = std::byte{kProtocolVersion + 1};
        payload.resize(payload.size() + 9);
        EXPECT_EQ(decode_error(payload), ErrorCode::kNone) << name;
        EXPECT_TRUE(is_plausible(payload[0], payload.size())) << name;
      }
    }
  }
}

// An edge at the very end belongs to the interval that made it; one nanosecond later does not.
TEST(Codec, AllowsAnEdgeAtTheEndOfItsInterval) {
  EXPECT_EQ(decode_error_with("EncoderEdges", 11, "46 5a 10 0000000000"),
            ErrorCode::kMessageBadField);
  // start 1000000 + 1 + 3770 + 74565 = 1078336 = 0x107440
  EXPECT_EQ(decode_error_with("EncoderEdges", 11, "4074100000000000"), ErrorCode::kNone);
  EXPECT_EQ(decode_error_with("EncoderEdges", 11, "3f74100000000000"), ErrorCode::kMessageBadField);
}

TEST(Codec, RefusesMoreEdgesThanAMessageHolds) {
  EncoderEdges edges;
  while (edges.edges.push_back(EncoderEdge(0, EncoderLine::kA))) {
  }
  std::vector<std::byte> bytes(kMaxPayloadSize);
  ASSERT_EQ(encode(edges, bytes), bytes.size());
  EXPECT_EQ(decode_error(bytes), ErrorCode::kNone);
  bytes.resize(bytes.size() + kBytesPerEdge);
  store_little_endian(bytes.data() + kEdgesHeaderSize - 2,
                      static_cast<std::uint16_t>(kMaxEdgesPerMessage + 1));
  EXPECT_EQ(decode_error(bytes), ErrorCode::kMessageBadField);
}

TEST(Codec, SumsTheStepsOfAFullMessageWithoutOverflow) {
  EncoderEdges edges;
  for (std::size_t i = 0; i < kMaxEdgesPerMessage; ++i) {
    ASSERT_TRUE(edges.edges.push_back(EncoderEdge(EncoderEdge::kMaxStep_ns, EncoderLine::kB)));
  }
  const core::Nanoseconds sum_ns = 1024LL * ((1LL << 30) - 1);
  std::array<std::byte, kMaxPayloadSize> bytes;
  edges.end_ns = sum_ns;
  EXPECT_EQ(decode_error(std::span<const std::byte>(bytes).first(encode(edges, bytes))),
            ErrorCode::kNone);
  edges.end_ns = sum_ns - 1;
  EXPECT_EQ(decode_error(std::span<const std::byte>(bytes).first(encode(edges, bytes))),
            ErrorCode::kMessageBadField);
}

TEST(Codec, RandomBytesNeverCrashAndWhatTheyYieldIsLegal) {
  core::Random random(20240501);
  Decoder decoder;
  std::array<std::byte, 128> bytes;
  std::uint64_t accepted = 0;
  for (int round = 0; round < 300'000; ++round) {
    for (auto& byte : bytes) {
      byte = static_cast<std::byte>(random.bits());
    }
    bytes[0] = static_cast<std::byte>(random.bits() % 18U);
    const auto payload =
        std::span<const std::byte>(bytes).first(random.bits() % (bytes.size() + 1));
    EncodingSink again;
    if (decoder.decode(payload, again).has_value()) {
      ++accepted;
      // What was accepted means exactly these bytes.
      const bool is_later_greeting = again.bytes.size() < payload.size();
      if (!is_later_greeting) {
        ASSERT_EQ(hex_of(again.bytes.data(), again.bytes.size()),
                  hex_of(payload.data(), payload.size()));
      }
    }
  }
  EXPECT_GT(accepted, 100U);
}

}  // namespace
}  // namespace towbench::protocol
