// Real GPIO lines through libgpiod, on a chip that the kernel simulates (gpio-sim). Where there is
// none these are skipped, and tests/carriers runs them in a machine that has it.
#include "protocol/carriers/gpio_lines.h"

#include <chrono>
#include <cstdlib>
#include <fstream>
#include <thread>

#include <gtest/gtest.h>

#include "protocol/carriers/line_address.h"
#include "protocol/carriers/sim_lines.h"
#include "tests/protocol/simulated_chip.h"

namespace towbench::protocol {
namespace {

class GpioLinesTest : public testing::Test {
 protected:
  void SetUp() override {
    if (!SimulatedChip::is_possible()) {
      // In the test machine it must be there: a skip would prove nothing.
      ASSERT_EQ(std::getenv("TOWBENCH_TEST_MACHINE"), nullptr) << "no gpio-sim";  // NOLINT
      GTEST_SKIP() << "this kernel has no gpio-sim";
    }
    chip_ = std::make_unique<SimulatedChip>(12);
    ASSERT_FALSE(chip_->name().empty());
  }
  std::unique_ptr<GpioLines> opened(LineSide side = LineSide::kController,
                                    core::Nanoseconds debounce_ns = 0) {
    auto lines =
        GpioLines::open({.chip = chip_->name(), .first_line = 2, .debounce_ns = debounce_ns}, side);
    EXPECT_TRUE(lines.has_value()) << lines.error().message;
    return lines ? std::move(*lines) : nullptr;
  }
  std::unique_ptr<SimLines> machine() { return std::move(*SimLines::open(chip_->name(), 2)); }
  static core::Nanoseconds now_ns() {
    return std::chrono::nanoseconds(std::chrono::steady_clock::now().time_since_epoch()).count();
  }
  std::unique_ptr<SimulatedChip> chip_;
};

TEST(GpioLinesOpening, NamesTheChipThatItCannotOpen) {
  const auto lines = GpioLines::open({.chip = "no-such-chip"}, LineSide::kController);
  ASSERT_FALSE(lines.has_value());
  EXPECT_TRUE(lines.error().message.starts_with("no-such-chip: no such GPIO chip"));
}

TEST(LineAddress, RefusesWhatIsNone) {
  for (const std::string text :
       {"", "+3", "gpiochip0+", "gpiochip0+x", "sim:", "sim:gpiochip0", "gpiochip0~",
        "gpiochip0~5ms", "gpiochip0~1001", "gpiochip0~5+3", "~5"}) {
    const auto lines = open_lines(text, LineSide::kController);
    ASSERT_FALSE(lines.has_value()) << text;
    EXPECT_NE(lines.error().message.find(std::string(kLineForms)), std::string::npos);
  }
}

TEST_F(GpioLinesTest, TheAddressSaysWhereTheLinesAreAndHowLongTheyBounce) {
  const auto controller = open_lines(chip_->name() + "+2~1000", LineSide::kController);
  ASSERT_TRUE(controller.has_value()) << controller.error().message;
  ASSERT_TRUE(machine()->write(1).has_value());  // and 0 again when it ends
  EXPECT_EQ((*controller)->read()->lines, 0U) << "not for a second yet";
}

TEST_F(GpioLinesTest, SeesEveryLineOfTheMachineAsItsOwnBit) {
  const auto controller = opened();
  const auto outside = machine();
  for (unsigned bit = 0; bit < kWiredInputLines; ++bit) {
    ASSERT_TRUE(outside->write(static_cast<std::uint16_t>(1U << bit)).has_value());
    EXPECT_EQ(controller->read()->lines, 1U << bit);
  }
  ASSERT_TRUE(outside->write(0x55).has_value());
  EXPECT_EQ(controller->read()->lines, 0x55U);
}

TEST_F(GpioLinesTest, DrivesTheAmplifierEnablesAndDropsThemWhenItEnds) {
  auto controller = opened();
  const auto outside = machine();
  EXPECT_EQ(outside->read()->lines, 0U) << "inactive at the start";
  ASSERT_TRUE(controller->write(3).has_value());
  EXPECT_EQ(outside->read()->lines, 3U);
  ASSERT_TRUE(controller->write(2).has_value());
  EXPECT_EQ(outside->read()->lines, 2U);
  controller.reset();
  EXPECT_EQ(outside->read()->lines, 0U) << "a controller that ends removes the drive";
}

TEST_F(GpioLinesTest, EdgesCarryTheKernelsTime) {
  const auto controller = opened();
  const auto outside = machine();
  (void)controller->read();
  const auto before_ns = now_ns();
  ASSERT_TRUE(outside->write(mask_of(InputLine::kKillSwitch)).has_value());
  const auto after_ns = now_ns();
  std::this_thread::sleep_for(std::chrono::milliseconds(20));  // read late: the time is the edge's
  const auto levels = controller->read();
  ASSERT_TRUE(levels.has_value());
  EXPECT_EQ(levels->edges, 1U);
  EXPECT_GE(levels->edge_ns, before_ns);
  EXPECT_LE(levels->edge_ns, after_ns);
}

TEST_F(GpioLinesTest, APulseBetweenTwoReadsIsNotLost) {
  const auto controller = opened();
  const auto outside = machine();
  (void)controller->read();
  ASSERT_TRUE(outside->write(1).has_value());
  ASSERT_TRUE(outside->write(0).has_value());
  const auto levels = controller->read();
  EXPECT_EQ(levels->lines, 0U);
  EXPECT_EQ(levels->edges, 2U);
}

TEST_F(GpioLinesTest, ALineThatBouncesCountsOnceItHasComeToRest) {
  constexpr core::Nanoseconds kDebounce_ns = 50 * core::kNanosecondsPerMillisecond;
  const auto controller = opened(LineSide::kController, kDebounce_ns);
  const auto outside = machine();
  for (int i = 0; i < 5; ++i) {
    ASSERT_TRUE(outside->write(1).has_value());
    ASSERT_TRUE(outside->write(0).has_value());
  }
  ASSERT_TRUE(outside->write(1).has_value());
  EXPECT_EQ(controller->read()->lines, 0U);
  const auto edge_ns = controller->read()->edge_ns;
  while (now_ns() - edge_ns < kDebounce_ns) {
    std::this_thread::yield();
  }
  EXPECT_EQ(controller->read()->lines, 1U);
}

TEST_F(GpioLinesTest, ThePlantsSideDrivesTheSevenAndReadsTheTwo) {
  const auto plant = opened(LineSide::kPlant);
  const auto level_of = [&](unsigned line) {
    std::string value;
    std::ifstream("/sys/bus/gpio/devices/" + chip_->name() + "/sim_gpio" + std::to_string(line) +
                  "/value") >>
        value;
    return value;
  };
  ASSERT_TRUE(plant->write(mask_of(InputLine::kAmplifierReadyX)).has_value());
  EXPECT_EQ(level_of(2 + 6), "1");
  EXPECT_EQ(level_of(2 + 0), "0");
  std::ofstream("/sys/bus/gpio/devices/" + chip_->name() + "/sim_gpio10/pull") << "pull-up";
  EXPECT_EQ(plant->read()->lines, mask_of(OutputLine::kAmplifierEnableX));
}

TEST_F(GpioLinesTest, ALineThatIsTakenIsNamedWithItsHolder) {
  const auto first = opened();
  const auto second = GpioLines::open({.chip = chip_->name(), .first_line = 2}, LineSide::kPlant);
  ASSERT_FALSE(second.has_value());
  EXPECT_NE(second.error().message.find("line 9 is taken by towbench"), std::string::npos)
      << second.error().message;
}

TEST_F(GpioLinesTest, TooFewLinesAreTold) {
  const auto lines = GpioLines::open({.chip = chip_->name(), .first_line = 4}, LineSide::kPlant);
  ASSERT_FALSE(lines.has_value());
  EXPECT_NE(lines.error().message.find("has 12 lines; 9 are wanted from line 4 on"),
            std::string::npos)
      << lines.error().message;
}

}  // namespace
}  // namespace towbench::protocol
