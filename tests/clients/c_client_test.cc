// The C client takes and refuses what the bench's own codec does, and its frames are the bench's.
#include <memory>
#include <random>

#include <gtest/gtest.h>

#include "clients/c/towbench.h"
#include "protocol/cobs.h"
#include "protocol/codec.h"
#include "protocol/frame.h"
#include "tests/protocol/any_message.h"
#include "tests/protocol/golden.h"
#include "tests/protocol/recording_sink.h"

namespace towbench::protocol {
namespace {

using Payload = std::vector<std::byte>;

class Payloads final : public EachMessage<Payloads> {
 public:
  template <typename Message>
  void handle(const Message& message) noexcept {
    Payload payload(kMaxPayloadSize);
    payload.resize(encode(message, payload));
    all.push_back(std::move(payload));
  }
  std::vector<Payload> all;
};

const std::uint8_t* bytes_in(const Payload& payload) {
  return reinterpret_cast<const std::uint8_t*>(payload.data());  // NOLINT: the same bytes
}

std::unique_ptr<tb_bench> client(tb_framing framing) {
  auto bench = std::make_unique<tb_bench>();
  tb_init(bench.get(), framing, 3, 1'000'000, TB_DIGEST | TB_REFERENCE);
  return bench;
}

core::ErrorCode verdict_of_bench(const Payload& payload) {
  static Decoder decoder;
  MessageSink nobody;
  const auto decoded = decoder.decode(payload, nobody);
  return decoded ? core::ErrorCode::kNone : decoded.error();
}

core::ErrorCode verdict_of_client(const Payload& payload) {
  const auto bench = client(TB_STREAM);
  if (tb_take(bench.get(), bytes_in(payload), payload.size()) != 0) {
    return core::ErrorCode::kNone;
  }
  const auto& counts = bench->counts;
  return counts.unknown != 0     ? core::ErrorCode::kMessageUnknown
         : counts.truncated != 0 ? core::ErrorCode::kFrameTruncated
                                 : core::ErrorCode::kMessageBadField;
}

std::vector<Payload> sound_payloads() {
  Payloads payloads;
  for (const auto& golden : golden_messages()) {
    golden.send(payloads);
  }
  AnyMessage any(5);
  for (int i = 0; i < 3000; ++i) {
    any.send_to(payloads);
  }
  return payloads.all;
}

TEST(CClient, TakesAndRefusesWhatTheCodecDoes) {
  std::mt19937 random(17);
  for (const auto& payload : sound_payloads()) {
    ASSERT_EQ(verdict_of_client(payload), core::ErrorCode::kNone);
    auto damaged = payload;
    damaged[random() % damaged.size()] = static_cast<std::byte>(random());
    ASSERT_EQ(verdict_of_client(damaged), verdict_of_bench(damaged))
        << hex_of(damaged.data(), damaged.size());
    damaged.resize(random() % (damaged.size() + 1));
    ASSERT_EQ(verdict_of_client(damaged), verdict_of_bench(damaged))
        << hex_of(damaged.data(), damaged.size());
    damaged = payload;
    damaged.push_back(std::byte{1});
    ASSERT_EQ(verdict_of_client(damaged), verdict_of_bench(damaged));
  }
}

TEST(CClient, CountsAsTheReportAndTheEdgesSay) {
  const auto bench = client(TB_STREAM);
  const auto take = [&](const auto& message) {
    Payloads one;
    one.on(message);
    ASSERT_NE(tb_take(bench.get(), bytes_in(one.all[0]), one.all[0].size()), 0);
  };
  take(EncoderReport{.axis = core::Axis::kX, .count_change = 7, .sequence = 3});
  take(EncoderReport{.axis = core::Axis::kX, .count_change = -9, .sequence = 4});
  EXPECT_EQ(bench->axis[TB_X].count, -2);
  EXPECT_EQ(bench->counts.sequence_gaps, 0U);
  take(EncoderReport{.axis = core::Axis::kX, .sequence = 6});
  EXPECT_EQ(bench->counts.sequence_gaps, 1U);
  EncoderEdges edges;  // A up, B up, A down: three forwards; then back by one
  edges.end_ns = 1'000'000;
  edges.edges.assign(std::vector{EncoderEdge(10, EncoderLine::kA), EncoderEdge(10, EncoderLine::kB),
                                 EncoderEdge(10, EncoderLine::kA),
                                 EncoderEdge(10, EncoderLine::kA)});
  take(edges);
  EXPECT_EQ(bench->axis[TB_Y].count, 2);
  take(Reference{core::Axis::kY, 5, 0.25F, -1.0F, 3.0F});
  EXPECT_EQ(bench->axis[TB_Y].reference.position_m, 0.25F);
  EXPECT_EQ(bench->axis[TB_Y].reference.acceleration_m_per_s2, 3.0F);
}

TEST(CClient, KnowsWhatAnAbsoluteEncoderTells) {
  const auto bench = client(TB_STREAM);
  const auto take = [&](const auto& message) {
    Payloads one;
    one.on(message);
    ASSERT_NE(tb_take(bench.get(), bytes_in(one.all[0]), one.all[0].size()), 0);
  };
  take(Advanced{});
  EXPECT_EQ(bench->counts.sequence_gaps, 0U) << "who tells nothing is not missed";
  EXPECT_EQ(bench->axis[TB_X].has_absolute, 0);
  take(AbsoluteCount{core::Axis::kX, 1'000'000, -70'000, 0});
  take(Advanced{1'000'000});
  take(AbsoluteCount{core::Axis::kX, 2'000'000, 123'456, 1});
  take(Advanced{2'000'000});
  EXPECT_EQ(bench->axis[TB_X].absolute, 123'456);
  EXPECT_EQ(bench->axis[TB_X].absolute_at_start, -70'000);
  EXPECT_EQ(bench->axis[TB_X].absolute_ns, 2'000'000);
  EXPECT_EQ(bench->axis[TB_X].has_absolute, 1);
  EXPECT_EQ(bench->axis[TB_Y].has_absolute, 0);
  EXPECT_EQ(bench->counts.sequence_gaps, 0U);
  take(Advanced{3'000'000});
  EXPECT_EQ(bench->counts.sequence_gaps, 1U) << "a turn without it";
  take(AbsoluteCount{core::Axis::kX, 4'000'000, 123'456, 3});
  take(Advanced{4'000'000});
  EXPECT_EQ(bench->counts.sequence_gaps, 2U) << "a gap in its sequence";
}

// What the client sends, as the bench reads it.
template <typename Reader>
std::vector<std::string> sent_by_client(tb_framing framing) {
  const auto bench = client(framing);
  tb_greet(bench.get());
  tb_enable(bench.get(), 3);
  tb_drive(bench.get(), TB_Y, 0.5, 1);
  tb_drive(bench.get(), TB_X, -2.0, 1);
  tb_drive(bench.get(), TB_X, std::numeric_limits<double>::quiet_NaN(), 1);
  tb_end_turn(bench.get());
  tb_say_bye(bench.get());
  RecordingSink sink;
  Reader reader;
  reader.feed(std::as_bytes(std::span(bench->out, bench->out_size)), sink);
  EXPECT_EQ(reader.counts().bad_crc, 0U);
  return sink.texts;
}

TEST(CClient, SendsWhatTheBenchReads) {
  const auto sent = sent_by_client<FrameReader>(TB_STREAM);
  ASSERT_EQ(sent.size(), 7U);
  EXPECT_EQ(sent_by_client<CobsReader>(TB_COBS), sent);
  RecordingSink texts;
  texts.on(DigitalOutputs{.lines = 3});
  texts.on(PwmDuty{.enable = true, .channel_a_ticks = 2500, .period_ticks = 5000});
  texts.on(PwmDuty{
      .axis = core::Axis::kX, .enable = true, .channel_b_ticks = 5000, .period_ticks = 5000});
  texts.on(PwmDuty{.axis = core::Axis::kX, .enable = true, .period_ticks = 5000, .sequence = 1});
  texts.on(Advance{1'000'000});
  texts.on(Bye{});
  EXPECT_EQ(std::vector(sent.begin() + 1, sent.end()), texts.texts);
}

}  // namespace
}  // namespace towbench::protocol
