// Both ends of a run by the wall clock, with the clock injected: no test waits.
#include "harness/realtime/realtime_plant.h"

#include <memory>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "emulator/truth_row.h"
#include "protocol/carriers/local_socket.h"
#include "protocol/carriers/lockstep_link.h"
#include "tests/harness/realtime/scripted_clock.h"

namespace towbench::harness {
namespace {

using core::ErrorCode;
using protocol::LockstepLink;

struct KeepingObserver final : emulator::PlantObserver {
  void on_truth(const emulator::TruthRow& row) noexcept override {
    times_ns.push_back(row.time_ns);
  }
  void on_event(const emulator::PlantEvent& event) noexcept override {
    kinds.push_back(event.kind);
  }
  std::vector<core::Nanoseconds> times_ns;
  std::vector<emulator::PlantEventKind> kinds;
};

struct KeepingController final : protocol::MessageSink {
  using MessageSink::on;
  void on(const protocol::Advanced& advanced) noexcept override { told_ns = advanced.time_ns; }
  core::Nanoseconds told_ns = -1;
};

class RealtimePlantTest : public testing::Test {
 protected:
  RealtimePlantTest() {
    auto pair = protocol::LocalSocket::pair();
    near_ = std::move(pair->first);
    far_ = std::move(pair->second);
    near_link_ = std::make_unique<LockstepLink>(*near_);
    far_link_ = std::make_unique<LockstepLink>(*far_);
  }
  std::unique_ptr<TickLoop> loop_of(core::Nanoseconds period_ns) {
    return std::make_unique<TickLoop>(clock_, TickPolicy{.period_ns = period_ns});
  }
  core::Status serve(emulator::PlantObserver& observer) {
    emulator::PlantNode plant(rig_, 1, {}, observer);
    const auto loop = loop_of(core::kPlantTick_ns);
    return serve_plant_in_real_time(plant, *far_link_, hello_, *loop);
  }

  ScriptedClock clock_;
  emulator::RigParameters rig_;
  protocol::Hello hello_{.axes_mask = 3,
                         .tick_ns = static_cast<std::uint32_t>(core::kPlantTick_ns),
                         .exchange_ns = 1'000'000,
                         .capabilities = protocol::kCapabilityDigest};
  std::unique_ptr<protocol::LocalSocket> near_;
  std::unique_ptr<protocol::LocalSocket> far_;
  std::unique_ptr<LockstepLink> near_link_;
  std::unique_ptr<LockstepLink> far_link_;
};

// A peer that takes everything and says nothing, or one word only.
class QuietLink final : public protocol::TurnLink {
 public:
  QuietLink() : TurnLink(core::kNanosecondsPerSecond) {}
  void say_advanced() { has_word_ = true; }
  [[nodiscard]] protocol::MessageSink& peer() noexcept override { return ignored_; }
  [[nodiscard]] const protocol::LinkCounts& counts() const noexcept override { return counts_; }

 private:
  core::Result<Progress> read_once(core::Nanoseconds /*timeout_ns*/) noexcept override {
    if (!has_word_) {
      return Progress::kNothing;
    }
    has_word_ = false;
    watch().on(protocol::Advanced{core::kPlantTick_ns});
    return Progress::kSomething;
  }
  bool has_word_ = false;
  class Ignored final : public protocol::MessageSink {
  } ignored_;
  protocol::LinkCounts counts_;
};

TEST_F(RealtimePlantTest, AControllerThatFallsSilentLosesTheDriveAfterASecond) {
  KeepingObserver observer;
  QuietLink link;
  emulator::PlantNode plant(rig_, 1, {}, observer);
  const auto loop = loop_of(core::kPlantTick_ns);
  const auto ended = serve_plant_in_real_time(plant, link, hello_, *loop);
  ASSERT_FALSE(ended.has_value());
  EXPECT_EQ(ended.error(), ErrorCode::kPeerSilent);
  EXPECT_EQ(plant.now_ns(), kRealtimeSilence_ns + core::kPlantTick_ns);
  using enum emulator::PlantEventKind;
  EXPECT_THAT(observer.kinds, testing::IsSupersetOf({kPeerLost, kDriveRemoved}));
}

TEST_F(RealtimePlantTest, AControllerThatIsGoneLosesTheDriveAtOnce) {
  KeepingObserver observer;
  near_.reset();
  const auto ended = serve(observer);
  ASSERT_FALSE(ended.has_value());
  EXPECT_EQ(ended.error(), ErrorCode::kPeerClosed);
  EXPECT_LE(observer.times_ns.size(), 2U);
}

TEST_F(RealtimePlantTest, ByeEndsItOrderlyAndAControllerCannotRunThePlantsClock) {
  KeepingObserver observer;
  near_link_->peer().on(protocol::Advance{core::kNanosecondsPerSecond});
  near_link_->peer().on(protocol::Bye{});
  EXPECT_TRUE(serve(observer).has_value());
  EXPECT_TRUE(observer.times_ns.empty() || observer.times_ns.back() <= core::kPlantTick_ns);
  EXPECT_EQ(observer.kinds.back(), emulator::PlantEventKind::kFinished);
}

TEST_F(RealtimePlantTest, TruthIsThinnedToWholeExchanges) {
  KeepingObserver observer;
  ThinnedTruth thinned(observer, 1'000'000);
  for (core::Nanoseconds t = core::kPlantTick_ns; t <= 3'000'000; t += core::kPlantTick_ns) {
    emulator::TruthRow row;
    row.time_ns = t;
    thinned.on_truth(row);
  }
  EXPECT_EQ(observer.times_ns, (std::vector<core::Nanoseconds>{1'000'000, 2'000'000, 3'000'000}));
}

TEST_F(RealtimePlantTest, TheControllerIsToldItsOwnTimeAndAPlantThatFallsSilentIsLost) {
  const auto loop = loop_of(core::kNanosecondsPerMillisecond);
  QuietLink link;
  RealtimePlantEnd end(link, *loop);
  KeepingController controller;
  end.connect(controller);
  link.say_advanced();
  end.sink().on(protocol::Advance{0});
  ASSERT_TRUE(end.wait_for(protocol::Turn::kAdvanced).has_value());
  EXPECT_EQ(controller.told_ns, 0);
  core::Status status;
  core::Nanoseconds until_ns = 0;
  while (status.has_value() && until_ns < 5 * core::kNanosecondsPerSecond) {
    until_ns += core::kNanosecondsPerMillisecond;
    end.sink().on(protocol::Advance{until_ns});
    status = end.wait_for(protocol::Turn::kAdvanced);
    EXPECT_TRUE(!status.has_value() || controller.told_ns == until_ns);
  }
  ASSERT_FALSE(status.has_value());
  EXPECT_EQ(status.error(), ErrorCode::kPeerSilent);
  EXPECT_EQ(until_ns, kRealtimeSilence_ns + core::kNanosecondsPerMillisecond);
  EXPECT_EQ(clock_.time_ns, until_ns);
}

}  // namespace
}  // namespace towbench::harness
