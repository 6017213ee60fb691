#include "bbmc/host/emulated_board.h"

#include <string>
#include <vector>

#include <gtest/gtest.h>

namespace towbench::bbmc {
namespace {

using core::ErrorCode;
using protocol::InputLine;

class EmulatedBoardTest : public ::testing::Test {
 protected:
  void SetUp() override {
    for (std::size_t i = 0; i < kLineCount; ++i) {
      const Line line = static_cast<Line>(i);
      ASSERT_TRUE(devices_.line(line).open());
      ASSERT_TRUE(devices_.line(line).init(
          {.output = !is_input(line), .interrupt_on_edges = is_input(line)}));
    }
    ASSERT_TRUE(devices_.interrupts().open());
    ASSERT_TRUE(devices_.interrupts().init({}));
  }

  void lines(protocol::InputLines levels, core::Nanoseconds time_ns) {
    ASSERT_TRUE(board_.take(
        protocol::DigitalInputs{.lines = levels, .change_ns = time_ns, .sequence = sequence_++}));
  }

  std::vector<Line> served() {
    std::vector<Line> order;
    Aintc::Reading edge;
    while (devices_.interrupts().read(edge)) {
      order.push_back(edge.line);
    }
    return order;
  }

  EmulatedBoard board_;
  DeviceManager devices_{board_.ports()};
  std::uint32_t sequence_ = 0;
};

TEST_F(EmulatedBoardTest, ServesLineEdgesByTimeAndThoseOfOneInstantByUrgency) {
  const protocol::InputLines hall = protocol::mask_of(InputLine::kHallXMax);
  const protocol::InputLines kill = protocol::mask_of(InputLine::kKillSwitch);
  const protocol::InputLines ready = protocol::mask_of(InputLine::kAmplifierReadyY);
  lines(hall, 500);
  lines(hall | ready | kill, 800);
  board_.set_time(1'000);
  EXPECT_EQ(served(), (std::vector{Line::kHallXMax, Line::kKillSwitch, Line::kAmplifierReadyY}));
  EXPECT_TRUE(served().empty());
}

TEST_F(EmulatedBoardTest, AnEdgeOfTheFutureWaitsForItsTime) {
  lines(protocol::mask_of(InputLine::kHallYMin), 2'000);
  board_.set_time(1'000);
  EXPECT_TRUE(served().empty());
  board_.set_time(2'000);
  EXPECT_EQ(served(), std::vector{Line::kHallYMin});
}

TEST_F(EmulatedBoardTest, AFloodOfBouncesNeverDrownsTheKillSwitch) {
  protocol::InputLines level = 0;
  for (int i = 0; i < 500; ++i) {
    level = static_cast<protocol::InputLines>(level ^ protocol::mask_of(InputLine::kHallYMax));
    lines(level, i);
  }
  lines(static_cast<protocol::InputLines>(level | protocol::mask_of(InputLine::kKillSwitch)), 600);
  for (int i = 0; i < 500; ++i) {
    level = static_cast<protocol::InputLines>(level ^ protocol::mask_of(InputLine::kHallYMax));
    lines(static_cast<protocol::InputLines>(level | protocol::mask_of(InputLine::kKillSwitch)),
          700 + i);
  }
  board_.set_time(10'000);
  const auto order = served();
  EXPECT_EQ(std::count(order.begin(), order.end(), Line::kKillSwitch), 1);
}

TEST_F(EmulatedBoardTest, AMaskedInterruptWaitsAndTheKillSwitchCannotBeMasked) {
  ASSERT_TRUE(devices_.interrupts().write({Line::kHallYMin, Aintc::Action::kMask}));
  ASSERT_TRUE(devices_.interrupts().config({.threshold = 1}));
  lines(protocol::mask_of(InputLine::kHallYMin) | protocol::mask_of(InputLine::kKillSwitch), 10);
  board_.set_time(100);
  EXPECT_EQ(served(), std::vector{Line::kKillSwitch});
  ASSERT_TRUE(devices_.interrupts().write({Line::kHallYMin, Aintc::Action::kUnmask}));
  ASSERT_TRUE(devices_.interrupts().config({}));
  EXPECT_EQ(served(), std::vector{Line::kHallYMin});
}

TEST_F(EmulatedBoardTest, ReportsAMissingChangeOfLines) {
  lines(0, 1);
  EXPECT_FALSE(board_.take(protocol::DigitalInputs{.lines = 1, .change_ns = 2, .sequence = 7}));
}

TEST_F(EmulatedBoardTest, SendsEachWrittenDutyOnceWithAscendingNumbers) {
  struct DutyRecorder final : protocol::MessageSink {
    using MessageSink::on;
    void on(const protocol::PwmDuty& duty) noexcept override { duties.push_back(duty); }
    std::vector<protocol::PwmDuty> duties;
  } plant;
  EhrpwmDriver& pwm = devices_.pwm(core::Axis::kX);
  ASSERT_TRUE(pwm.open());
  ASSERT_TRUE(pwm.init({}));
  board_.flush(plant);
  ASSERT_TRUE(pwm.write({.channel_b_ticks = 77, .enable = true}));
  board_.flush(plant);
  board_.flush(plant);
  ASSERT_EQ(plant.duties.size(), 2U);
  EXPECT_EQ(plant.duties[0].channel_b_ticks, 0);
  EXPECT_EQ(plant.duties[1].channel_b_ticks, 77);
  EXPECT_EQ(plant.duties[1].axis, core::Axis::kX);
  EXPECT_EQ(plant.duties[1].sequence, plant.duties[0].sequence + 1);
}

TEST_F(EmulatedBoardTest, TheUartTakesAllOfAChunkOrNothing) {
  ASSERT_TRUE(devices_.console().open());
  ASSERT_TRUE(devices_.console().init({}));
  Uart::Chunk chunk;
  ASSERT_TRUE(chunk.assign(std::string(Uart::kChunk, 'a')));
  std::size_t taken = 0;
  while (devices_.console().write(chunk)) {
    taken += chunk.size();
  }
  EXPECT_EQ(devices_.console().write(chunk).error(), ErrorCode::kDeviceFull);
  std::string out(2 * taken, ' ');
  EXPECT_EQ(board_.console().read_out(out), taken);
  EXPECT_TRUE(devices_.console().write(chunk));
}

TEST_F(EmulatedBoardTest, TheUartHandsTypedBytesOnInOrder) {
  ASSERT_TRUE(devices_.console().open());
  ASSERT_TRUE(devices_.console().init({}));
  EXPECT_EQ(board_.console().type("status\r"), 7U);
  Uart::Chunk chunk;
  ASSERT_TRUE(devices_.console().read(chunk));
  EXPECT_EQ(std::string(chunk.begin(), chunk.end()), "status\r");
  EXPECT_EQ(devices_.console().read(chunk).error(), ErrorCode::kDeviceNoData);
}

}  // namespace
}  // namespace towbench::bbmc
