#include "protocol/carriers/can_link.h"

#include <deque>
#include <vector>

#include <gtest/gtest.h>

#include "tests/protocol/recording_sink.h"

namespace towbench::protocol {
namespace {

using core::ErrorCode;

// Two ports on one bus in memory, with what a bus can do to frames.
class MemoryPort final : public CanPort {
 public:
  void join(MemoryPort& other) { other_ = &other; }
  core::Status send(std::span<const CanFrame> frames) noexcept override {
    if (fails_with != ErrorCode::kNone) {
      return core::failure(fails_with);
    }
    sends.push_back(frames.size());
    other_->waiting_.insert(other_->waiting_.end(), frames.begin(), frames.end());
    return {};
  }
  core::Result<std::size_t> receive(std::span<CanFrame> into,
                                    core::Nanoseconds /*timeout_ns*/) noexcept override {
    if (waiting_.empty() && fails_with != ErrorCode::kNone) {
      return core::failure(fails_with);
    }
    std::size_t size = 0;
    while (size < into.size() && !waiting_.empty()) {
      into[size++] = waiting_.front();
      waiting_.pop_front();
    }
    return size;
  }
  std::deque<CanFrame>& waiting() { return waiting_; }

  std::vector<std::size_t> sends;
  ErrorCode fails_with = ErrorCode::kNone;

 private:
  MemoryPort* other_ = nullptr;
  std::deque<CanFrame> waiting_;
};

class CanLinkTest : public testing::Test {
 protected:
  static constexpr core::Nanoseconds kShort_ns = 5 * core::kNanosecondsPerMillisecond;
  CanLinkTest() {
    a_.join(b_);
    b_.join(a_);
  }
  MemoryPort a_;
  MemoryPort b_;
  CanLink controller_{a_, CanDirection::kToPlant, kShort_ns};
  CanLink plant_{b_, CanDirection::kToController, kShort_ns};
  RecordingSink heard_;
};

TEST_F(CanLinkTest, TheFramesOfATurnLeaveTogetherAndArriveAsTheyWere) {
  controller_.peer().on(PwmDuty{.channel_a_ticks = 7, .period_ticks = 100, .sequence = 0});
  controller_.peer().on(DigitalOutputs{.lines = 3, .change_ns = 5, .sequence = 0});
  EXPECT_TRUE(a_.sends.empty());
  controller_.peer().on(Advance{1'000'000});
  ASSERT_EQ(a_.sends, std::vector<std::size_t>{3});
  const auto turn = plant_.wait(heard_);
  ASSERT_TRUE(turn.has_value());
  EXPECT_EQ(*turn, Turn::kAdvance);
  EXPECT_EQ(heard_.texts, (std::vector<std::string>{"PwmDuty y 0 7 0 100 0", "DigitalOutputs 3 5 0",
                                                    "Advance 1000000"}));
}

TEST_F(CanLinkTest, OffersTheDigestOnlyWhateverItsSideCan) {
  controller_.peer().on(Hello{.capabilities = kCapabilityEdges | kCapabilityDigest});
  ASSERT_TRUE(plant_.wait(heard_).has_value());
  ASSERT_EQ(heard_.texts.size(), 1U);
  EXPECT_EQ(heard_.texts[0], text_of(Hello{.capabilities = kCapabilityDigest}));
  plant_.peer().on(HelloReply{.plant = {.role = Role::kPlant, .capabilities = kCapabilityEdges}});
  ASSERT_TRUE(controller_.wait_for(Turn::kHelloReply, heard_).has_value());
  EXPECT_EQ(heard_.texts[1],
            text_of(HelloReply{.plant = {.role = Role::kPlant, .capabilities = 0}}));
}

TEST_F(CanLinkTest, ByTheWallClockATurnEndsWithoutAFrameButForASignOfLifeNowAndThen) {
  controller_.go_by_the_wall_clock();
  for (std::uint32_t i = 0; i < 100; ++i) {
    controller_.peer().on(PwmDuty{.channel_a_ticks = 7, .period_ticks = 100, .sequence = i});
    controller_.peer().on(Heartbeat{.time_ns = 1'000'000 * core::Nanoseconds{i}, .sequence = i});
  }
  ASSERT_EQ(a_.sends.size(), 100U) << "each turn leaves at once";
  EXPECT_EQ(controller_.frames_sent(), 102U);
  ASSERT_TRUE(plant_.listen(heard_, 0).has_value());
  ASSERT_TRUE(plant_.listen(heard_, 0).has_value());
  ASSERT_EQ(heard_.texts.size(), 102U);
  EXPECT_EQ(heard_.texts[1], text_of(Heartbeat{.time_ns = 0, .sequence = 0}));
  EXPECT_EQ(heard_.texts[52], text_of(Heartbeat{.time_ns = 50'000'000, .sequence = 50}));
  EXPECT_EQ(heard_.texts[101],
            text_of(PwmDuty{.channel_a_ticks = 7, .period_ticks = 100, .sequence = 99}));
}

TEST_F(CanLinkTest, APeerThatBabblesWithoutEndingItsTurnIsSilent) {
  for (int i = 0; i < 10'000; ++i) {
    a_.waiting().push_back(can_frame(can_id::kLines + 1U, static_cast<std::uint64_t>(i)));
  }
  const auto status = controller_.wait_for(Turn::kAdvanced, heard_);
  ASSERT_FALSE(status.has_value());
  EXPECT_EQ(status.error(), ErrorCode::kPeerSilent);
}

TEST_F(CanLinkTest, ABusThatFailsEndsTheRunForGood) {
  a_.fails_with = ErrorCode::kTransportFailed;
  controller_.peer().on(Advance{1});
  EXPECT_EQ(controller_.wait_for(Turn::kAdvanced, heard_).error(), ErrorCode::kTransportFailed);
  a_.fails_with = ErrorCode::kNone;
  plant_.peer().on(Advanced{1});
  EXPECT_EQ(controller_.wait_for(Turn::kAdvanced, heard_).error(), ErrorCode::kTransportFailed);
}

TEST_F(CanLinkTest, AMillionCorruptedFramesCrashNothingAndTheLinkStillWorks) {
  std::uint64_t state = 88172645463325252ULL;  // xorshift64
  const auto random = [&state] {
    state ^= state << 13U;
    state ^= state >> 7U;
    state ^= state << 17U;
    return state;
  };
  CountingSink sink;
  for (int batch = 0; batch < 10'000; ++batch) {
    for (int i = 0; i < 100; ++i) {
      // Mostly the plant's identifiers, with any content and any length.
      constexpr std::array kIds{can_id::kFault, can_id::kBye,      can_id::kLines, can_id::kIndex,
                                can_id::kLong,  can_id::kLockstep, can_id::kDigest};
      const std::uint64_t dice = random();
      const std::uint32_t id = dice % 16 == 0 ? static_cast<std::uint32_t>(dice >> 32U) & 0x7ffU
                                              : kIds[dice / 16 % kIds.size()] + (dice >> 60U) % 2;
      CanFrame frame = can_frame(id, random());
      frame.size = static_cast<std::uint8_t>(dice % 8 == 0 ? random() % 9 : 8);
      a_.waiting().push_back(frame);
    }
    ASSERT_TRUE(controller_.listen(sink, 0).has_value());
    ASSERT_TRUE(controller_.listen(sink, 0).has_value());
  }
  EXPECT_EQ(controller_.frames_received(), 1'000'000U);
  EXPECT_GT(controller_.counts().errors(), 100'000U);
  while (controller_.wait(sink).has_value() && !a_.waiting().empty()) {
  }
  plant_.peer().on(Advanced{123});
  RecordingSink heard;
  ASSERT_TRUE(controller_.listen(heard, 0).has_value());
  EXPECT_EQ(heard.texts, std::vector<std::string>{"Advanced 123"});
}

}  // namespace
}  // namespace towbench::protocol
