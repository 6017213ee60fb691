// BBMC's drivers on real GPIO lines, on a chip that the kernel simulates (gpio-sim). Where there is
// none these are skipped, and tests/carriers runs them in a machine that has it.
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <memory>

#include <gtest/gtest.h>

#include "bbmc/host/linux/linux_board.h"
#include "tests/bbmc/support/fake_board.h"

namespace towbench::bbmc {
namespace {

namespace fs = std::filesystem;
using core::Axis;
using core::ErrorCode;

// Nine lines, in the order of bbmc::Line.
class SimulatedChip {
 public:
  SimulatedChip() {
    fs::create_directory(device_);
    fs::create_directory(device_ / "bank0");
    std::ofstream(device_ / "bank0/num_lines") << kLineCount;
    std::ofstream(device_ / "live") << 1;
    std::ifstream(device_ / "bank0/chip_name") >> name_;
  }
  SimulatedChip(const SimulatedChip&) = delete;
  SimulatedChip& operator=(const SimulatedChip&) = delete;
  ~SimulatedChip() {
    std::ofstream(device_ / "live") << 0;
    fs::remove(device_ / "bank0");
    fs::remove(device_);
  }
  [[nodiscard]] std::string place_of(Line line) const {
    return name_ + ':' + std::to_string(index_of(line));
  }
  // What is wired to the line's outside.
  void pull(Line line, bool up) const {
    std::ofstream(outside(line) + "pull") << (up ? "pull-up" : "pull-down");
  }
  [[nodiscard]] int value(Line line) const {
    int number = -1;
    std::ifstream(outside(line) + "value") >> number;
    return number;
  }
  static bool is_possible() { return fs::exists("/sys/kernel/config/gpio-sim"); }

 private:
  [[nodiscard]] std::string outside(Line line) const {
    return "/sys/bus/gpio/devices/" + name_ + "/sim_gpio" + std::to_string(index_of(line)) + '/';
  }
  fs::path device_ = "/sys/kernel/config/gpio-sim/towbench-bbmc";
  std::string name_;
};

class ChipLineTest : public ::testing::Test {
 protected:
  void SetUp() override {
    if (!SimulatedChip::is_possible()) {
      // In the test machine it must be there: a skip would prove nothing.
      ASSERT_EQ(std::getenv("TOWBENCH_TEST_MACHINE"), nullptr) << "no gpio-sim";  // NOLINT
      GTEST_SKIP() << "this kernel has no gpio-sim";
    }
    chip_ = std::make_unique<SimulatedChip>();
    wired_ = fake_.devices();
    for (Axis axis : core::kPlanarAxes) {
      LinuxAxis& lines = wired_.axes[axis];
      lines.hall_min = chip_->place_of(hall_min_of(axis));
      lines.hall_max = chip_->place_of(hall_max_of(axis));
      lines.amplifier_ready = chip_->place_of(amplifier_ready_of(axis));
      lines.amplifier_enable = chip_->place_of(amplifier_enable_of(axis));
    }
    wired_.kill_switch = chip_->place_of(Line::kKillSwitch);
  }
  void make_ready() {
    const auto status = board_.open(wired_);
    ASSERT_TRUE(status) << board_.trouble().message();
    for (std::size_t i = 0; i < kLineCount; ++i) {
      const auto line = static_cast<Line>(i);
      ASSERT_TRUE(devices_.line(line).open());
      ASSERT_TRUE(devices_.line(line).init(
          {.output = !is_input(line), .interrupt_on_edges = is_input(line)}));
    }
    ASSERT_TRUE(devices_.interrupts().open());
    ASSERT_TRUE(devices_.interrupts().init({}));
    ASSERT_TRUE(board_.sample(0)) << board_.trouble().message();
  }
  static constexpr core::Nanoseconds kLater_ns = core::Nanoseconds{1} << 60U;

  tests::FakeBoard fake_;
  std::unique_ptr<SimulatedChip> chip_;
  LinuxDevices wired_;
  LinuxBoard board_;
  DeviceManager devices_{board_.ports()};
};

TEST_F(ChipLineTest, EveryEdgeIsAnInterruptWithTheKernelsTime) {
  make_ready();
  chip_->pull(Line::kKillSwitch, true);
  chip_->pull(Line::kKillSwitch, false);  // shorter than any sample
  chip_->pull(Line::kHallXMax, true);
  ASSERT_TRUE(board_.sample(kLater_ns)) << board_.trouble().message();
  Aintc::Reading first;
  Aintc::Reading second;
  Aintc::Reading third;
  ASSERT_TRUE(devices_.interrupts().read(first));
  ASSERT_TRUE(devices_.interrupts().read(second));
  ASSERT_TRUE(devices_.interrupts().read(third));
  EXPECT_EQ(first.line, Line::kKillSwitch);
  EXPECT_TRUE(first.active);
  EXPECT_EQ(second.line, Line::kKillSwitch);
  EXPECT_FALSE(second.active);
  EXPECT_EQ(third.line, Line::kHallXMax);
  EXPECT_GT(first.time_ns, 0);
  EXPECT_GT(second.time_ns, first.time_ns);
  EXPECT_GT(third.time_ns, second.time_ns);
  Gpio::Reading level;
  ASSERT_TRUE(devices_.line(Line::kHallXMax).read(level));
  EXPECT_TRUE(level.active);
}

TEST_F(ChipLineTest, AnActiveLowSwitchIsPressedWhenItsLineFalls) {
  chip_->pull(Line::kKillSwitch, true);
  wired_.kill_switch = '!' + wired_.kill_switch;
  make_ready();
  Gpio::Reading level;
  ASSERT_TRUE(devices_.line(Line::kKillSwitch).read(level));
  EXPECT_FALSE(level.active);
  chip_->pull(Line::kKillSwitch, false);
  ASSERT_TRUE(board_.sample(kLater_ns));
  Aintc::Reading edge;
  ASSERT_TRUE(devices_.interrupts().read(edge));
  EXPECT_TRUE(edge.active);
}

TEST_F(ChipLineTest, AmplifiersAreEnabledByTheDriverAndOffWhenSafe) {
  make_ready();
  EXPECT_EQ(chip_->value(Line::kAmplifierEnableY), 0);
  ASSERT_TRUE(devices_.line(Line::kAmplifierEnableY).write({.active = true}));
  ASSERT_TRUE(board_.flush());
  EXPECT_EQ(chip_->value(Line::kAmplifierEnableY), 1);
  EXPECT_EQ(chip_->value(Line::kAmplifierEnableX), 0);
  board_.make_safe();
  EXPECT_EQ(chip_->value(Line::kAmplifierEnableY), 0);
}

TEST_F(ChipLineTest, ALineThatSomebodyElseHoldsIsBusy) {
  make_ready();
  LinuxBoard other;
  EXPECT_EQ(other.open(wired_).error(), ErrorCode::kDeviceBusy);
}

TEST_F(ChipLineTest, ALineThatTheChipDoesNotHaveIsNamed) {
  wired_.kill_switch += '0';  // 40 of 9
  EXPECT_EQ(board_.open(wired_).error(), ErrorCode::kDeviceUnknown);
  EXPECT_NE(board_.trouble().message().find(wired_.kill_switch), std::string::npos);
}

}  // namespace
}  // namespace towbench::bbmc
