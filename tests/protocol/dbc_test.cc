// macs.dbc against the frames that are really sent.
#include <fstream>
#include <set>

#include <gtest/gtest.h>

#include "protocol/carriers/can_packer.h"
#include "tests/protocol/any_message.h"
#include "tests/protocol/can_sinks.h"
#include "tests/protocol/dbc_reader.h"

namespace towbench::protocol {
namespace {

class Dbc : public testing::Test {
 protected:
  std::map<std::uint32_t, DbcMessage> messages_ = read_dbc("protocol/macs.dbc");

  // The value of one signal of the last frame sent.
  std::int64_t value(const CanFrame& frame, const std::string& signal) {
    for (const DbcSignal& s : messages_.at(frame.id).signals) {
      if (s.name == signal) {
        return raw_value(s, frame);
      }
    }
    ADD_FAILURE() << signal << " is not in the message";
    return 0;
  }
};

TEST_F(Dbc, IsReadWhole) {
  std::ifstream file("protocol/macs.dbc");
  unsigned messages = 0;
  unsigned signals = 0;
  for (std::string line; std::getline(file, line);) {
    messages += line.starts_with("BO_ ") ? 1U : 0U;
    signals += line.starts_with(" SG_ ") ? 1U : 0U;
  }
  unsigned read = 0;
  for (const auto& [id, message] : messages_) {
    read += static_cast<unsigned>(message.signals.size());
  }
  EXPECT_EQ(messages_.size(), messages);
  EXPECT_EQ(read, signals);
}

TEST_F(Dbc, GivesEveryBitOfAFrameToOneSignal) {
  for (const auto& [id, message] : messages_) {
    const bool is_fd = (id & ~7U) == can_id::kEdges;
    EXPECT_EQ(message.size, is_fd ? kCanFdDataSize : kCanDataSize) << message.name;
    std::set<unsigned> bits;
    for (const DbcSignal& s : message.signals) {
      EXPECT_TRUE(s.is_little_endian) << s.name;
      for (unsigned i = 0; i < s.length; ++i) {
        EXPECT_TRUE(bits.insert(s.start + i).second) << message.name << ": " << s.name;
      }
    }
    EXPECT_EQ(bits.size(), 8 * message.size) << message.name;
    EXPECT_EQ(*bits.rbegin(), 8 * message.size - 1) << message.name;
  }
}

TEST_F(Dbc, KnowsEveryFrameThatIsSentItsSenderAndItsRanges) {
  for (const auto direction : {CanDirection::kToPlant, CanDirection::kToController}) {
    KeepingFrames frames;
    CanPacker packer(direction, frames, true);
    AnyMessage any(6);
    for (int i = 0; i < 5000; ++i) {
      // Each side sends its own messages only.
      const unsigned kinds[2][8] = {{0, 2, 6, 9, 11, 12, 13, 13}, {1, 4, 5, 7, 10, 11, 12, 3}};
      any.send_to(packer, kinds[static_cast<unsigned>(direction)][i % 8]);
    }
    for (const CanFrame& frame : frames.frames) {
      ASSERT_TRUE(messages_.contains(frame.id)) << std::hex << frame.id;
      const DbcMessage& message = messages_.at(frame.id);
      ASSERT_EQ(message.sender, direction == CanDirection::kToPlant ? "Controller" : "Plant")
          << message.name;
      for (const DbcSignal& s : message.signals) {
        const auto raw = static_cast<double>(raw_value(s, frame));
        ASSERT_GE(raw, s.min) << message.name << ": " << s.name;
        ASSERT_LE(raw, s.max) << message.name << ": " << s.name;
      }
    }
  }
}

TEST_F(Dbc, ReadsADutyAsItWasMeant) {
  KeepingFrames frames;
  CanPacker packer(CanDirection::kToPlant, frames);
  packer.on(PwmDuty{.axis = core::Axis::kY,
                    .enable = true,
                    .channel_a_ticks = 0,
                    .channel_b_ticks = 4321,
                    .period_ticks = 5000,
                    .sequence = 77});
  const CanFrame& frame = frames.frames.at(0);
  EXPECT_EQ(messages_.at(frame.id).name, "DutyY");
  EXPECT_EQ(value(frame, "ChannelA"), 0);
  EXPECT_EQ(value(frame, "ChannelB"), 4321);
  EXPECT_EQ(value(frame, "Period"), 5000);
  EXPECT_EQ(value(frame, "Enable"), 1);
  EXPECT_EQ(value(frame, "Sequence"), 77);
}

TEST_F(Dbc, ReadsADigestAndItsIndexAsTheyWereMeant) {
  KeepingFrames frames;
  CanPacker packer(CanDirection::kToController, frames);
  EncoderReport report{.axis = core::Axis::kX, .levels = 1, .sequence = 10};
  for (int i = 0; i < 2; ++i) {
    report.time_ns += core::kNanosecondsPerMillisecond;
    packer.on(report);
    ++report.sequence;
  }
  frames.frames.clear();
  report.time_ns += core::kNanosecondsPerMillisecond;
  report.count_change = -3;
  report.levels = 6;
  report.last_edge_ns = report.time_ns - 1234;
  report.capture_period_ns = 98'765;
  report.index_count = -70'000;
  report.index_pulses = 1;
  packer.on(report);
  ASSERT_EQ(frames.frames.size(), 2U);
  const CanFrame& index = frames.frames[0];
  EXPECT_EQ(messages_.at(index.id).name, "IndexX");
  EXPECT_EQ(value(index, "Count"), -70'000);
  EXPECT_EQ(value(index, "Pulses"), 1);
  EXPECT_EQ(value(index, "Sequence"), 12);
  const CanFrame& digest = frames.frames[1];
  EXPECT_EQ(messages_.at(digest.id).name, "DigestX");
  EXPECT_EQ(value(digest, "CountChange"), -3);
  EXPECT_EQ(value(digest, "Levels"), 6);
  EXPECT_EQ(value(digest, "Edges"), 2);
  EXPECT_EQ(value(digest, "IndexFollowed"), 1);
  EXPECT_EQ(value(digest, "Sequence"), 12);
  EXPECT_EQ(value(digest, "LastEdgeAge"), 1234);
  EXPECT_EQ(value(digest, "CapturePeriod"), 98'765);
}

TEST_F(Dbc, ReadsLinesAndHeartbeatsAsTheyWereMeant) {
  KeepingFrames frames;
  CanPacker packer(CanDirection::kToController, frames);
  packer.on(DigitalInputs{mask_of(InputLine::kKillSwitch), 123'456'789'012, 9});
  packer.on(Heartbeat{42, 3});
  EXPECT_EQ(messages_.at(frames.frames.at(0).id).name, "DigitalInputs");
  EXPECT_EQ(value(frames.frames.at(0), "Levels"), 16);
  EXPECT_EQ(value(frames.frames.at(0), "Sequence"), 9);
  EXPECT_EQ(value(frames.frames.at(0), "ChangeTime"), 123'456'789'012);
  EXPECT_EQ(messages_.at(frames.frames.at(1).id).name, "HeartbeatToController");
  EXPECT_EQ(value(frames.frames.at(1), "Sequence"), 3);
  EXPECT_EQ(value(frames.frames.at(1), "Time"), 42);
}

}  // namespace
}  // namespace towbench::protocol
