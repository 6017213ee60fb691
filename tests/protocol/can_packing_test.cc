#include <gtest/gtest.h>

#include "core/random.h"
#include "protocol/carriers/can_packer.h"
#include "protocol/carriers/can_unpacker.h"
#include "tests/protocol/any_message.h"
#include "tests/protocol/can_sinks.h"
#include "tests/protocol/counter_model.h"
#include "tests/protocol/golden.h"
#include "tests/protocol/recording_sink.h"

namespace towbench::protocol {
namespace {

struct Link {
  explicit Link(CanDirection direction)
      : unpacker(direction), bus(unpacker, received), packer(direction, bus) {}
  RecordingSink received;
  CanUnpacker unpacker;
  DirectBus bus;
  CanPacker packer;
};

TEST(CanPacking, LosesNoBitOfAnyMessageButRefusesEdges) {
  for (const auto direction : {CanDirection::kToPlant, CanDirection::kToController}) {
    Link link(direction);
    RecordingSink sent;
    AnyMessage any(5);
    AnyMessage again(5);
    std::uint64_t edges = 0;
    for (int i = 0; i < 3000; ++i) {
      RecordingSink one;
      again.send_to(one);
      any.send_to(link.packer);
      if (one.texts.front().starts_with("EncoderEdges")) {
        ++edges;
      } else {
        sent.texts.push_back(one.texts.front());
      }
    }
    EXPECT_EQ(link.received.texts, sent.texts);
    EXPECT_EQ(link.packer.refused(), edges);
    EXPECT_EQ(link.unpacker.counts().errors(), 0U);
  }
}

TEST(CanPacking, SendsADigestInOneFrameAtEverySpeedWithoutLoss) {
  for (const double mean_edges : {0.0, 0.3, 1.0, 5.0, 142.0}) {
    Link link(CanDirection::kToController);
    CounterModel model(9);
    RecordingSink sent;
    constexpr int kReports = 20'000;
    std::uint64_t pulses = 0;
    for (int i = 0; i < kReports; ++i) {
      const EncoderReport report = model.next(mean_edges);
      pulses += report.index_pulses != 0 ? 1U : 0U;
      link.packer.on(report);
      sent.on(report);
    }
    ASSERT_EQ(link.received.texts, sent.texts) << mean_edges;
    // Two whole reports of seven frames in 256, an extra frame for each index pulse; a first edge
    // and a standstill longer than the field may cost a few more whole ones.
    const double expected = kReports * (1.0 + 2.0 / 256.0 * 6.0) + static_cast<double>(pulses);
    EXPECT_NEAR(link.bus.frames, expected, 40.0) << mean_edges;
  }
}

TEST(CanPacking, SendsADutyInOneFrameAcrossTheWrapOfItsSequence) {
  Link link(CanDirection::kToPlant);
  RecordingSink sent;
  for (std::uint32_t i = 0; i < 70'000; ++i) {
    const PwmDuty duty{.axis = core::Axis::kX,
                       .enable = i % 3 == 0,
                       .channel_b_ticks = static_cast<std::uint16_t>(i % 5001),
                       .period_ticks = 5000,
                       .sequence = i};
    link.packer.on(duty);
    sent.on(duty);
  }
  EXPECT_EQ(link.received.texts, sent.texts);
  EXPECT_EQ(link.bus.frames, 70'000);
}

TEST(CanPacking, ALostDigestIsNoticedAndCaughtUpWithinTheWholeReports) {
  Link link(CanDirection::kToController);
  CounterModel model(3);
  RecordingSink sent;
  for (int i = 0; i < 1000; ++i) {
    link.bus.lose_next = i == 100 ? 1 : 0;
    const EncoderReport report = model.next(20.0);
    link.packer.on(report);
    if (i < 100 || i >= 256) {
      sent.on(report);
    }
  }
  EXPECT_EQ(link.received.texts, sent.texts) << "nothing wrong is delivered in between";
  EXPECT_EQ(link.unpacker.reports_without_reference(), 155U);
}

TEST(CanPacking, ADigestWhoseIndexFrameWasLostIsNotDelivered) {
  Link link(CanDirection::kToController);
  EncoderReport report{.sequence = 10};
  for (int i = 0; i < 3; ++i) {
    report.time_ns += core::kNanosecondsPerMillisecond;
    const bool at_index = i == 2;
    report.index_pulses = at_index ? 1 : 0;
    report.index_count = at_index ? 4000 : 0;
    link.bus.lose_next = at_index ? 1 : 0;  // the index frame goes first
    link.packer.on(report);
    ++report.sequence;
  }
  EXPECT_EQ(link.received.texts.size(), 2U);
  EXPECT_EQ(link.unpacker.reports_without_reference(), 1U);
}

TEST(CanPacking, ALostDutyShowsAsAGapInTheSequence) {
  Link link(CanDirection::kToPlant);
  for (std::uint32_t i = 0; i < 5; ++i) {
    link.bus.lose_next = i == 2 ? 1 : 0;
    link.packer.on(PwmDuty{.period_ticks = 10, .sequence = i});
  }
  EXPECT_EQ(link.received.texts,
            (std::vector<std::string>{"PwmDuty y 0 0 0 10 0", "PwmDuty y 0 0 0 10 1",
                                      "PwmDuty y 0 0 0 10 3", "PwmDuty y 0 0 0 10 4"}));
}

TEST(CanPacking, AMessageThatLostASegmentIsDroppedAndTheNextArrives) {
  for (int lost = 0; lost < 5; ++lost) {
    Link link(CanDirection::kToPlant);
    link.packer.on(Advance{1});
    KeepingFrames frames;
    CanPacker packer(CanDirection::kToPlant, frames);
    packer.on(Hello{});
    packer.on(Hello{.axes_mask = 3});
    ASSERT_EQ(frames.frames.size(), 10U);  // 1 + 25 + 4 bytes, seven a frame
    frames.frames.erase(frames.frames.begin() + lost);
    for (const CanFrame& frame : frames.frames) {
      link.unpacker.take(frame, link.received);
    }
    EXPECT_EQ(link.received.texts.size(), 2U);
    EXPECT_GT(link.unpacker.counts().errors(), 0U);
  }
}

TEST(CanPacking, IgnoresFramesOfOthersAndOfTheOtherDirection) {
  KeepingFrames frames;
  CanPacker packer(CanDirection::kToPlant, frames);
  AnyMessage any(1);
  for (int i = 0; i < 500; ++i) {
    any.send_to(packer);
  }
  frames.frames.push_back(CanFrame{.id = 0x7ff, .size = 8});
  CanUnpacker unpacker(CanDirection::kToController);
  CountingSink sink;
  for (const CanFrame& frame : frames.frames) {
    unpacker.take(frame, sink);
  }
  EXPECT_EQ(sink.count, 0U);
  EXPECT_EQ(unpacker.counts(), LinkCounts{});
}

TEST(CanPacking, SurvivesAMillionCorruptedFramesAndDeliversOnlyWhatIsLegal) {
  core::Random random(77);
  KeepingFrames pool;
  CanPacker packer(CanDirection::kToController, pool);
  AnyMessage any(2);
  CounterModel model(4);
  for (int i = 0; i < 2000; ++i) {
    any.send_to(packer);
    packer.on(model.next(10.0));
  }
  CanUnpacker unpacker(CanDirection::kToController);
  CountingSink sink;
  for (int i = 0; i < 1'000'000; ++i) {
    CanFrame frame = pool.frames[random.bits() % pool.frames.size()];
    frame.data[random.bits() % kCanDataSize] ^= static_cast<std::uint8_t>(random.bits());
    frame.size =
        random.bits() % 50 == 0 ? static_cast<std::uint8_t>(random.bits() % 9) : frame.size;
    unpacker.take(frame, sink);
  }
  EXPECT_EQ(sink.count, unpacker.counts().frames);
  EXPECT_GT(unpacker.counts().errors(), 1000U);
  // Still running: a whole conversation passes.
  RecordingSink received;
  DirectBus bus(unpacker, received);
  CanPacker fresh(CanDirection::kToController, bus);
  fresh.on(HelloReply{});
  fresh.on(Advanced{5});
  EXPECT_EQ(received.texts.size(), 2U);
}

TEST(CanPacking, WritesTheExactBits) {
  KeepingFrames frames;
  CanPacker packer(CanDirection::kToPlant, frames);
  packer.on(PwmDuty{.axis = core::Axis::kX,
                    .enable = true,
                    .channel_a_ticks = 0x1234,
                    .channel_b_ticks = 0,
                    .period_ticks = 0x2710,
                    .sequence = 5});
  packer.on(Advance{0x0102030405060708});
  ASSERT_EQ(frames.frames.size(), 2U);
  // Enable is bit 48, the sequence 5 stands above it: 5 << 1 | 1 = 0x000b.
  EXPECT_EQ(frames.frames[0],
            (CanFrame{0x101, 8, {0x34, 0x12, 0x00, 0x00, 0x10, 0x27, 0x0b, 0x00}}));
  EXPECT_EQ(frames.frames[1], (CanFrame{0x200, 8, {8, 7, 6, 5, 4, 3, 2, 1}}));
}

}  // namespace
}  // namespace towbench::protocol
