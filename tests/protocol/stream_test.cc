// What holds for every framing: typed tests over length framing and COBS.
#include <algorithm>
#include <cstring>

#include <gtest/gtest.h>

#include "core/random.h"
#include "protocol/cobs.h"
#include "protocol/frame.h"
#include "tests/protocol/any_message.h"
#include "tests/protocol/byte_sinks.h"
#include "tests/protocol/golden.h"
#include "tests/protocol/recording_sink.h"
#include "tests/support/allocation_guard.h"

namespace towbench::protocol {
namespace {

template <typename WriterType, typename ReaderType>
struct Pair {
  using Writer = WriterType;
  using Reader = ReaderType;
};

template <typename P>
class Stream : public testing::Test {
 public:
  using Writer = typename P::Writer;
  using Reader = typename P::Reader;

  static std::vector<std::byte> stream_of(std::uint64_t seed, int messages,
                                          RecordingSink* sent = nullptr) {
    KeepingByteSink out;
    Writer writer(out, FlushAt::kRequest);
    AnyMessage any(seed);
    AnyMessage again(seed);
    for (int i = 0; i < messages; ++i) {
      any.send_to(writer);
      if (sent != nullptr) {
        again.send_to(*sent);
      }
    }
    EXPECT_TRUE(writer.flush().has_value());
    return out.bytes;
  }
};

using Framings = testing::Types<Pair<FrameWriter, FrameReader>, Pair<CobsWriter, CobsReader>>;
TYPED_TEST_SUITE(Stream, Framings);

TYPED_TEST(Stream, DeliversEveryMessageInOrder) {
  RecordingSink sent;
  const auto bytes = this->stream_of(1, 500, &sent);
  typename TestFixture::Reader reader;
  RecordingSink received;
  reader.feed(bytes, received);
  reader.finish(received);
  EXPECT_EQ(received.texts, sent.texts);
  EXPECT_EQ(reader.counts().frames, 500U);
  EXPECT_EQ(reader.counts().errors(), 0U);
  EXPECT_EQ(reader.counts().skipped_bytes, 0U);
}

TYPED_TEST(Stream, DoesNotCareHowBytesAreCutIntoPortions) {
  RecordingSink sent;
  const auto bytes = this->stream_of(2, 200, &sent);
  core::Random random(3);
  for (const std::uint64_t longest : {1U, 2U, 3U, 7U, 100U, 5000U, 20000U}) {
    typename TestFixture::Reader reader;
    RecordingSink received;
    for (std::size_t at = 0; at < bytes.size();) {
      const std::size_t size =
          std::min<std::size_t>(1 + random.bits() % longest, bytes.size() - at);
      reader.feed(std::span(bytes).subspan(at, size), received);
      at += size;
    }
    ASSERT_EQ(received.texts, sent.texts) << "portions up to " << longest;
    ASSERT_EQ(reader.counts().errors(), 0U);
  }
}

TYPED_TEST(Stream, FindsTheNextMessageAfterGarbage) {
  core::Random random(5);
  for (int round = 0; round < 200; ++round) {
    std::vector<std::byte> bytes(1 + random.bits() % 300);
    for (auto& byte : bytes) {
      byte = static_cast<std::byte>(random.bits());
    }
    // A serial line hears at least one delimiter of an idle sender before a frame.
    bytes.push_back(std::byte{0});
    RecordingSink sent;
    // Longer than any frame that the garbage may announce.
    const auto good = this->stream_of(static_cast<std::uint64_t>(round), 60, &sent);
    bytes.insert(bytes.end(), good.begin(), good.end());
    typename TestFixture::Reader reader;
    RecordingSink received;
    reader.feed(bytes, received);
    ASSERT_GE(received.texts.size(), sent.texts.size());
    ASSERT_TRUE(std::equal(sent.texts.rbegin(), sent.texts.rend(), received.texts.rbegin()));
  }
}

TYPED_TEST(Stream, ADamagedFrameCostsNoMoreThanItselfAndItsNeighbour) {
  core::Random random(11);
  for (int round = 0; round < 300; ++round) {
    RecordingSink sent;
    auto bytes = this->stream_of(static_cast<std::uint64_t>(round), 40, &sent);
    bytes[random.bits() % bytes.size()] ^= static_cast<std::byte>(1 + random.bits() % 255);
    typename TestFixture::Reader reader;
    RecordingSink received;
    reader.feed(bytes, received);
    reader.finish(received);
    ASSERT_GE(received.texts.size() + 2, sent.texts.size());
    ASSERT_GE(reader.counts().errors(), 1U);
    // What arrives is a subsequence of what was sent: damage never invents a message.
    auto next = sent.texts.begin();
    for (const std::string& text : received.texts) {
      next = std::find(next, sent.texts.end(), text);
      ASSERT_NE(next, sent.texts.end()) << text;
      ++next;
    }
  }
}

// Each frame with one to four of its bytes overwritten, half a million for either framing: none
// crashes, and nothing but what by chance stayed intact is delivered.
TYPED_TEST(Stream, SurvivesAMillionCorruptedFrames) {
  constexpr int kFrames = 500'000;
  std::vector<std::vector<std::byte>> pool;
  for (std::uint64_t seed = 0; seed < 400; ++seed) {
    pool.push_back(this->stream_of(seed, 1));
  }
  core::Random random(17);
  typename TestFixture::Reader reader;
  CountingSink received;
  std::uint64_t intact = 0;
  std::vector<std::byte> bytes;
  for (int i = 0; i < kFrames; ++i) {
    const auto& original = pool[random.bits() % pool.size()];
    bytes = original;
    for (std::uint64_t hit = 1 + random.bits() % 4; hit > 0; --hit) {
      bytes[random.bits() % bytes.size()] = static_cast<std::byte>(random.bits());
    }
    intact += bytes == original ? 1U : 0U;
    reader.feed(bytes, received);
  }
  reader.finish(received);
  EXPECT_EQ(reader.counts().frames, received.count);
  EXPECT_LE(received.count, intact);
  EXPECT_LT(intact, kFrames / 100);
  EXPECT_GT(reader.counts().errors(), 0U);
  // The reader still runs: an intact stream passes.
  const std::uint64_t before = received.count;
  reader.feed(std::vector<std::byte>{std::byte{0}}, received);
  reader.feed(this->stream_of(23, 400), received);
  EXPECT_EQ(received.count, before + 400);
}

TYPED_TEST(Stream, SurvivesAFloodOfRandomBytes) {
  core::Random random(29);
  typename TestFixture::Reader reader;
  CountingSink received;
  std::vector<std::byte> bytes(65536);
  for (int round = 0; round < 64; ++round) {
    for (auto& byte : bytes) {
      byte = static_cast<std::byte>(random.bits());
    }
    reader.feed(bytes, received);
  }
  EXPECT_EQ(received.count, 0U);
  EXPECT_GT(reader.counts().errors(), 0U);
}

TYPED_TEST(Stream, CountsAFrameThatTheEndCutsOff) {
  auto bytes = this->stream_of(1, 3);
  bytes.pop_back();
  typename TestFixture::Reader reader;
  CountingSink received;
  reader.feed(bytes, received);
  EXPECT_EQ(reader.counts().truncated, 0U);
  reader.finish(received);
  EXPECT_EQ(received.count, 2U);
  EXPECT_EQ(reader.counts().truncated, 1U);
  EXPECT_EQ(reader.counts().errors(), 1U);
}

TYPED_TEST(Stream, CountsAMessageWithABadFieldAndGoesOn) {
  KeepingByteSink out;
  typename TestFixture::Writer writer(out);
  writer.on(PwmDuty{.period_ticks = 0});  // the sender's bug
  writer.on(Advance{5});
  typename TestFixture::Reader reader;
  RecordingSink received;
  reader.feed(out.bytes, received);
  EXPECT_EQ(received.texts, std::vector<std::string>{"Advance 5"});
  EXPECT_EQ(reader.counts().bad_field, 1U);
}

TYPED_TEST(Stream, WritesATurnInOnePiece) {
  KeepingByteSink out;
  typename TestFixture::Writer writer(out);
  writer.on(PwmDuty{.period_ticks = 1});
  writer.on(DigitalOutputs{});
  EXPECT_EQ(out.writes, 0);
  writer.on(Advance{1});
  EXPECT_EQ(out.writes, 1);
  EXPECT_EQ(writer.bytes_written(), out.bytes.size());
}

TYPED_TEST(Stream, WritesEarlyRatherThanDropWhenATurnOutgrowsTheBuffer) {
  RecordingSink sent;
  KeepingByteSink out;
  typename TestFixture::Writer writer(out);
  for (unsigned i = 0; i < 50; ++i) {
    EncoderEdges edges;
    edges.sequence = i;
    edges.end_ns = kMaxEdgesPerMessage;
    while (edges.edges.push_back(EncoderEdge(1, EncoderLine::kA))) {
    }
    writer.on(edges);
    sent.on(edges);
  }
  EXPECT_TRUE(writer.flush().has_value());
  EXPECT_GT(out.writes, 1);
  typename TestFixture::Reader reader;
  RecordingSink received;
  reader.feed(out.bytes, received);
  EXPECT_EQ(received.texts, sent.texts);
}

TYPED_TEST(Stream, AFailureToWriteStays) {
  KeepingByteSink out;
  out.failure = core::ErrorCode::kPeerClosed;
  typename TestFixture::Writer writer(out);
  writer.on(Advance{1});
  EXPECT_EQ(writer.status().error(), core::ErrorCode::kPeerClosed);
  out.failure = core::ErrorCode::kNone;
  writer.on(Advance{2});
  EXPECT_EQ(writer.status().error(), core::ErrorCode::kPeerClosed);
  EXPECT_TRUE(out.bytes.empty()) << "a stream with a hole is no stream";
}

}  // namespace
}  // namespace towbench::protocol
