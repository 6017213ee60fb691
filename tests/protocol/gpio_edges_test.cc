// Encoder channels on real GPIO lines, on a chip that the kernel simulates (gpio-sim). Where there
// is none these are skipped, and tests/carriers runs them in a machine that has it.
#include "protocol/carriers/gpio_edges.h"

#include <cstdlib>
#include <memory>
#include <vector>

#include <gtest/gtest.h>

#include "protocol/carriers/encoder_address.h"
#include "protocol/carriers/sim_edges.h"
#include "tests/protocol/simulated_chip.h"

namespace towbench::protocol {
namespace {

class GpioEdgesTest : public testing::Test {
 protected:
  void SetUp() override {
    if (!SimulatedChip::is_possible()) {
      ASSERT_EQ(std::getenv("TOWBENCH_TEST_MACHINE"), nullptr) << "no gpio-sim";  // NOLINT
      GTEST_SKIP() << "this kernel has no gpio-sim";
    }
    chip_ = std::make_unique<SimulatedChip>(12);
    place_ = {.chip = chip_->name(), .first_line = 3, .with_index = true};
  }
  std::unique_ptr<EdgeReader> reader() {
    auto opened = GpioEdgeReader::open(place_);
    EXPECT_TRUE(opened.has_value()) << opened.error().message;
    return opened ? std::move(*opened) : nullptr;
  }
  std::unique_ptr<EdgeDriver> machine() { return std::move(*SimEdgeDriver::open(place_)); }
  // `count` steps of X's quadrature upwards: A, B, A, B.
  static void turn(EdgeDriver& driver, unsigned count) {
    for (unsigned i = 0; i < count; ++i) {
      const auto line = i % 2 == 0 ? EncoderLine::kA : EncoderLine::kB;
      ASSERT_TRUE(driver.set(place_of(core::Axis::kX, line), i % 4 < 2).has_value());
    }
  }
  std::unique_ptr<SimulatedChip> chip_;
  EdgePlace place_;
};

TEST_F(GpioEdgesTest, KeepsTheOrderOfEdgesAcrossLines) {
  const auto machine_side = machine();
  const auto controller = reader();
  const std::vector<unsigned> driven{0, 1, 5, 0, 2, 3, 4, 1, 5, 5};
  std::vector<bool> levels(kEncoderChannelsAndIndex, false);
  for (const unsigned place : driven) {
    levels[place] = !levels[place];
    ASSERT_TRUE(machine_side->set(place, levels[place]).has_value());
  }
  const auto edges = controller->read();
  ASSERT_TRUE(edges.has_value());
  std::vector<unsigned> read;
  for (const LineEdge& edge : *edges) {
    read.push_back(edge.place);
  }
  EXPECT_EQ(read, driven);
  for (unsigned place = 0; place < levels.size(); ++place) {
    EXPECT_EQ(((static_cast<unsigned>(*controller->levels()) >> place) & 1U) != 0, levels[place]);
  }
}

TEST_F(GpioEdgesTest, EdgesCarryTheKernelsTimeInOrder) {
  const auto machine_side = machine();
  const auto controller = reader();
  const auto before_ns = controller->now_ns();
  turn(*machine_side, 8);
  const auto after_ns = controller->now_ns();
  const auto edges = controller->read();
  ASSERT_TRUE(edges.has_value());
  ASSERT_EQ(edges->size(), 8U);
  core::Nanoseconds last_ns = before_ns;
  for (const LineEdge& edge : *edges) {
    EXPECT_GE(edge.time_ns, last_ns);
    last_ns = edge.time_ns;
  }
  EXPECT_LE(last_ns, after_ns);
}

TEST_F(GpioEdgesTest, KeepsAWholeQueueBetweenTwoReads) {
  const auto machine_side = machine();
  const auto controller = reader();
  turn(*machine_side, kEdgeQueue);
  const auto edges = controller->read();
  ASSERT_TRUE(edges.has_value());
  EXPECT_EQ(edges->size(), kEdgeQueue);
}

TEST_F(GpioEdgesTest, AnEdgeThatTheKernelThrewAwayIsALoss) {
  const auto machine_side = machine();
  const auto controller = reader();
  turn(*machine_side, kEdgeQueue + 4);
  const auto edges = controller->read();
  ASSERT_FALSE(edges.has_value());
  EXPECT_EQ(edges.error(), core::ErrorCode::kSequence);
}

TEST_F(GpioEdgesTest, TheMachinesSideDrivesARealChipToo) {
  const auto driver = GpioEdgeDriver::open(place_);
  ASSERT_TRUE(driver.has_value()) << driver.error().message;
  const auto level_of = [&](unsigned line) {
    std::string value;
    std::ifstream("/sys/bus/gpio/devices/" + chip_->name() + "/sim_gpio" + std::to_string(line) +
                  "/value") >>
        value;
    return value;
  };
  ASSERT_TRUE((*driver)->set(place_of(core::Axis::kX, EncoderLine::kB), true).has_value());
  EXPECT_EQ(level_of(3 + 3), "1");
  EXPECT_EQ(level_of(3 + 0), "0");
}

TEST_F(GpioEdgesTest, ALineThatIsTakenIsNamedWithItsHolder) {
  const auto first = reader();
  const auto second = GpioEdgeDriver::open(place_);
  ASSERT_FALSE(second.has_value());
  EXPECT_NE(second.error().message.find("line 3 is taken by towbench encoder"), std::string::npos)
      << second.error().message;
}

TEST_F(GpioEdgesTest, TooFewLinesAreTold) {
  place_.first_line = 7;
  const auto lines = GpioEdgeReader::open(place_);
  ASSERT_FALSE(lines.has_value());
  EXPECT_NE(lines.error().message.find("has 12 lines; 6 are wanted from line 7 on"),
            std::string::npos)
      << lines.error().message;
}

}  // namespace
}  // namespace towbench::protocol
