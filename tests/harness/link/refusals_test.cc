// What a machine refuses of its controller is told with both sides' values, and counted.
#include "harness/link/refusals.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "harness/fixtures/rig_fixture.h"
#include "harness/link/unrecorded_plant.h"
#include "protocol/tee_sink.h"

namespace towbench::harness {
namespace {

using ::testing::HasSubstr;
using ::testing::StartsWith;

class RefusalsTest : public ::testing::Test {
 protected:
  RefusalsTest()
      : refusals_(unrecorded_, [this](const std::string& line) { told_.push_back(line); }),
        plant_(load_rig("fixtures/rigs/macs-nominal.toml", sources_).parameters, 1, {}, refusals_),
        to_plant_(refusals_.heard(), plant_) {
    plant_.connect(controller_);
  }

  void greet(const protocol::Hello& hello) { to_plant_.on(hello); }
  static protocol::Hello good() {
    return {.role = protocol::Role::kController,
            .axes_mask = 3,
            .tick_ns = 100'000,
            .exchange_ns = 1'000'000,
            .capabilities = protocol::kCapabilityEdges};
  }

  UnrecordedPlant unrecorded_;
  SourceFiles sources_;
  std::vector<std::string> told_;
  Refusals refusals_;
  emulator::PlantNode plant_;
  protocol::MessageSink controller_;
  protocol::TeeSink to_plant_;
};

TEST_F(RefusalsTest, AHelloIsRefusedWithBothSidesValues) {
  auto hello = good();
  hello.version = 99;
  greet(hello);
  hello = good();
  hello.tick_ns = 50'000;
  greet(hello);
  ASSERT_EQ(told_.size(), 2U);
  EXPECT_THAT(told_[0], HasSubstr("controller 99"));
  EXPECT_THAT(told_[0], HasSubstr("plant "));
  EXPECT_THAT(told_[1], HasSubstr("plant 100000 ns"));
  EXPECT_THAT(told_[1], HasSubstr("controller 50000 ns"));
}

TEST_F(RefusalsTest, WhatMakesNoSenseIsToldWithWhatWasSent) {
  greet(good());
  EXPECT_TRUE(told_.empty());
  to_plant_.on(protocol::PwmDuty{.axis = core::Axis::kY, .enable = true});
  to_plant_.on(protocol::Advance{.until_ns = 150'000});
  to_plant_.on(protocol::Advance{.until_ns = 1'000'000});
  to_plant_.on(protocol::Advance{.until_ns = 500'000});
  ASSERT_EQ(told_.size(), 3U);
  EXPECT_THAT(told_[0], HasSubstr("of 0 ticks"));
  EXPECT_THAT(told_[1], HasSubstr("Advance until 150000 ns"));
  EXPECT_THAT(told_[2], StartsWith("refused at 1000000 ns: Advance until 500000 ns"));
  EXPECT_EQ(refusals_.refused(), 3U);
}

TEST_F(RefusalsTest, AFloodIsCountedAndNotAllTold) {
  greet(good());
  for (int i = 0; i < 100; ++i) {
    to_plant_.on(protocol::Advance{.until_ns = 0});
    to_plant_.on(protocol::Advance{.until_ns = 100'000 * (i + 1)});
    to_plant_.on(protocol::Advance{.until_ns = 0});
  }
  EXPECT_LE(told_.size(), 21U);
  EXPECT_GE(refusals_.refused(), 100U);
}

TEST(Dropped, NamesEachReason) {
  EXPECT_EQ(Refusals::dropped({}), "");
  EXPECT_EQ(Refusals::dropped({.frames = 9, .unknown = 2, .bad_field = 1}),
            "1 with a field out of range, 2 of an unknown kind");
}

}  // namespace
}  // namespace towbench::harness
