#include "protocol/carriers/paced_can.h"

#include <deque>
#include <vector>

#include <gtest/gtest.h>

#include "protocol/carriers/can_layout.h"

namespace towbench::protocol {
namespace {

constexpr core::Nanoseconds kUs = core::kNanosecondsPerMicrosecond;
// 8 bytes at 1 Mbit/s with the worst stuffing: 135 bits (Davis et al. 2007).
constexpr core::Nanoseconds kFrame_ns = 135 * kUs;

class FakeClock final : public WireClock {
 public:
  core::Nanoseconds now_ns() noexcept override { return time_ns; }
  void wait_until(core::Nanoseconds until_ns) noexcept override {
    time_ns = std::max(time_ns, until_ns);
  }
  core::Nanoseconds time_ns = 0;
};

// A virtual bus: all that was put on it is there at once.
class InstantBus final : public CanPort {
 public:
  core::Status send(std::span<const CanFrame> frames) noexcept override {
    sent += frames.size();
    return {};
  }
  core::Result<std::size_t> receive(std::span<CanFrame> into,
                                    core::Nanoseconds /*timeout_ns*/) noexcept override {
    if (waiting.empty() && ended) {
      return core::failure(core::ErrorCode::kPeerClosed);
    }
    std::size_t size = 0;
    while (size < into.size() && !waiting.empty()) {
      into[size++] = waiting.front();
      waiting.pop_front();
    }
    return size;
  }
  std::deque<CanFrame> waiting;
  std::size_t sent = 0;
  bool ended = false;
};

class PacedCanTest : public testing::Test {
 protected:
  void put(std::uint64_t frames) {
    for (std::uint64_t i = 0; i < frames; ++i) {
      bus_.waiting.push_back(can_frame(can_id::kDigest, i));
    }
  }
  // When each frame was received.
  std::vector<core::Nanoseconds> arrivals(std::size_t count) {
    std::vector<core::Nanoseconds> times_ns;
    std::array<CanFrame, 8> into;
    for (int i = 0; i < 10'000 && times_ns.size() < count; ++i) {
      const auto size = paced_.receive(into, core::kNanosecondsPerSecond);
      EXPECT_TRUE(size.has_value());
      for (std::size_t k = 0; size && k < *size; ++k) {
        EXPECT_EQ(into[k], can_frame(can_id::kDigest, times_ns.size()));
        times_ns.push_back(clock_.time_ns);
      }
    }
    return times_ns;
  }
  FakeClock clock_;
  InstantBus bus_;
  PacedCan paced_{bus_, clock_, 1'000'000};
};

TEST_F(PacedCanTest, ABurstArrivesFrameByFrameAsAWireWouldBringIt) {
  put(300);
  const auto times_ns = arrivals(300);
  ASSERT_EQ(times_ns.size(), 300U);
  for (std::size_t i = 0; i < times_ns.size(); ++i) {
    EXPECT_EQ(times_ns[i], static_cast<core::Nanoseconds>(i + 1) * kFrame_ns);
  }
}

TEST_F(PacedCanTest, WhatThisNodeSendsKeepsTheSharedWireBusy) {
  const std::vector<CanFrame> own(10, can_frame(can_id::kDuty, 1));
  ASSERT_TRUE(paced_.send(own).has_value());
  EXPECT_EQ(bus_.sent, 10U);
  EXPECT_EQ(clock_.time_ns, 0) << "to send takes no time of the sender's";
  put(1);
  EXPECT_EQ(arrivals(1), std::vector<core::Nanoseconds>{11 * kFrame_ns});
}

TEST_F(PacedCanTest, WithoutPatienceNothingIsWaitedFor) {
  put(2);
  std::array<CanFrame, 8> into;
  EXPECT_EQ(paced_.receive(into, 0).value(), 0U);
  EXPECT_EQ(clock_.time_ns, 0);
  EXPECT_EQ(paced_.receive(into, kFrame_ns - kUs).value(), 0U);
  EXPECT_EQ(clock_.time_ns, kFrame_ns - kUs);
  EXPECT_EQ(paced_.receive(into, kFrame_ns).value(), 1U);
  EXPECT_EQ(clock_.time_ns, kFrame_ns);
}

TEST_F(PacedCanTest, ABusThatEndsFirstBringsWhatIsUnderWay) {
  put(2);
  bus_.ended = true;
  EXPECT_EQ(arrivals(2).size(), 2U);
  std::array<CanFrame, 8> into;
  EXPECT_EQ(paced_.receive(into, kUs).error(), core::ErrorCode::kPeerClosed);
}

}  // namespace
}  // namespace towbench::protocol
