// The kernel's devices behind BBMC's drivers, on a folder that imitates them.
#include "bbmc/host/linux/linux_board.h"

#include <filesystem>

#include <gtest/gtest.h>

#include "tests/bbmc/support/fake_board.h"

namespace towbench::bbmc {
namespace {

using core::Axis;
using core::ErrorCode;
using tests::FakeBoard;

class LinuxBoardTest : public ::testing::Test {
 protected:
  ErrorCode opened() {
    const auto status = board_.open(fake_.devices());
    return status ? ErrorCode::kNone : status.error();
  }
  // Opened, and the Y encoder and PWM ready.
  void SetUp() override {}
  void make_ready() {
    ASSERT_EQ(opened(), ErrorCode::kNone) << board_.trouble().message();
    ASSERT_TRUE(devices_.encoder(Axis::kY).open());
    ASSERT_TRUE(devices_.encoder(Axis::kY).init({}));
    ASSERT_TRUE(devices_.pwm(Axis::kY).open());
    ASSERT_TRUE(devices_.pwm(Axis::kY).init({.period_ticks = 1000}));
    ASSERT_TRUE(board_.sample(0));
  }
  Eqep::Reading counted(std::uint64_t count, core::Nanoseconds now_ns) {
    fake_.write(FakeBoard::count_file(Axis::kY), count);
    EXPECT_TRUE(board_.sample(now_ns));
    Eqep::Reading reading;
    EXPECT_TRUE(devices_.encoder(Axis::kY).read(reading));
    return reading;
  }
  std::uint64_t duty_ns(unsigned channel) {
    return fake_.read(FakeBoard::pwm_file(Axis::kY, channel, "duty_cycle"));
  }

  FakeBoard fake_;
  LinuxBoard board_;
  DeviceManager devices_{board_.ports()};
};

TEST_F(LinuxBoardTest, OpeningPutsNothingOutWhateverWasLeftRunning) {
  fake_.write(FakeBoard::pwm_file(Axis::kX, 1, "duty_cycle"), 4000);
  fake_.write(FakeBoard::pwm_file(Axis::kX, 1, "enable"), 1);
  fake_.write(FakeBoard::line_file(Line::kAmplifierEnableX), 1);
  ASSERT_EQ(opened(), ErrorCode::kNone) << board_.trouble().message();
  EXPECT_TRUE(fake_.is_safe());
}

TEST_F(LinuxBoardTest, ExportsAChannelThatIsNotThereYet) {
  std::filesystem::remove_all(fake_.root().string() + "/sys/class/pwm/pwmchip0/pwm1");
  // Nobody answers the export here, so the channel stays away; what was asked for is what counts.
  EXPECT_EQ(opened(), ErrorCode::kDeviceUnknown);
  EXPECT_EQ(fake_.first_line("/sys/class/pwm/pwmchip0/export"), "1");
}

TEST_F(LinuxBoardTest, EveryMissingNodeIsNamedWithItsNumber) {
  for (const std::string& missing :
       {FakeBoard::count_file(Axis::kX), FakeBoard::pwm_file(Axis::kY, 0, "duty_cycle"),
        FakeBoard::line_file(Line::kHallXMax), FakeBoard::line_file(Line::kKillSwitch)}) {
    FakeBoard fake;
    std::filesystem::remove(fake.root().string() + missing);
    LinuxBoard board;
    const auto status = board.open(fake.devices());
    ASSERT_FALSE(status) << missing;
    EXPECT_EQ(status.error(), ErrorCode::kDeviceUnknown);
    EXPECT_EQ(board.trouble().message(),
              "cannot open " + fake.root().string() + missing + ": No such file or directory");
  }
}

TEST_F(LinuxBoardTest, ALineWithoutAnOffsetIsRefused) {
  LinuxDevices devices = fake_.devices();
  for (const char* wrong : {"gpiochip1", "gpiochip1:", "gpiochip1:x", ":", "gpiochip1:3 "}) {
    devices.kill_switch = wrong;
    LinuxBoard board;
    EXPECT_EQ(board.open(devices).error(), ErrorCode::kDeviceBadArgument) << wrong;
  }
}

TEST_F(LinuxBoardTest, AWriteThatTheKernelRefusesIsANumberedError) {
  fake_.refuse_every_write(FakeBoard::pwm_file(Axis::kX, 0, "enable"));
  EXPECT_EQ(opened(), ErrorCode::kTransportFailed);
  EXPECT_TRUE(board_.trouble().message().ends_with("No space left on device"))
      << board_.trouble().message();
}

TEST_F(LinuxBoardTest, APeriodThatTheKernelRefusesLeavesTheDriverUninitialised) {
  fake_.refuse_the_value(FakeBoard::pwm_file(Axis::kY, 0, "period"));
  ASSERT_EQ(opened(), ErrorCode::kNone) << board_.trouble().message();
  ASSERT_TRUE(devices_.pwm(Axis::kY).open());
  EXPECT_EQ(devices_.pwm(Axis::kY).init({.period_ticks = 1000}).error(),
            ErrorCode::kDeviceBadArgument);
  EXPECT_EQ(devices_.pwm(Axis::kY).state(), DriverState::kOpened);
}

TEST_F(LinuxBoardTest, APeriodThatReadsBackOtherwiseIsRefused) {
  // What is written there is swallowed, and reads as nothing.
  const std::string period = FakeBoard::pwm_file(Axis::kY, 0, "period");
  std::filesystem::remove(fake_.root().string() + period);
  std::filesystem::create_symlink("/dev/null", fake_.root().string() + period);
  ASSERT_EQ(opened(), ErrorCode::kNone);
  ASSERT_TRUE(devices_.pwm(Axis::kY).open());
  EXPECT_EQ(devices_.pwm(Axis::kY).init({}).error(), ErrorCode::kDeviceNoData);
  EXPECT_TRUE(board_.trouble().message().ends_with("period holds no number"));
}

TEST_F(LinuxBoardTest, SetsTheCounterUpAndThePwmWithoutDuty) {
  make_ready();
  EXPECT_EQ(fake_.first_line("/sys/bus/counter/devices/counter0/count0/function"), "quadrature x4");
  EXPECT_EQ(fake_.read("/sys/bus/counter/devices/counter0/count0/ceiling"), 4294967295U);
  EXPECT_EQ(fake_.read("/sys/bus/counter/devices/counter0/count0/enable"), 1U);
  EXPECT_EQ(fake_.read(FakeBoard::pwm_file(Axis::kY, 1, "period")), 10'000U);
  EXPECT_EQ(fake_.first_line(FakeBoard::pwm_file(Axis::kY, 1, "polarity")), "normal");
  EXPECT_TRUE(fake_.is_safe());
}

TEST_F(LinuxBoardTest, CountsFromWhereItStandsAndAcrossTheWrap) {
  fake_.write(FakeBoard::count_file(Axis::kY), 4294967290U);
  make_ready();
  EXPECT_EQ(counted(4294967295U, 1'000'000).position, 5U);
  EXPECT_EQ(counted(4, 2'000'000).position, 10U);
  EXPECT_EQ(counted(4294967290U, 3'000'000).position, 0U);
}

TEST_F(LinuxBoardTest, ALoadedPositionMovesOnWithTheCount) {
  make_ready();
  EXPECT_EQ(counted(100, 1'000'000).position, 100U);
  ASSERT_TRUE(devices_.encoder(Axis::kY).write({.position = 5'000}));
  EXPECT_EQ(counted(103, 2'000'000).position, 5'003U);
}

TEST_F(LinuxBoardTest, APeriodIsTheTimeBetweenSamplesThatMovedSharedAmongTheirEdges) {
  make_ready();
  (void)counted(1, 1'000'000);
  const auto reading = counted(3, 9'000'000);
  // 8 ms for two edges at 1.5625 MHz.
  EXPECT_TRUE(reading.capture_valid);
  EXPECT_EQ(reading.capture_ticks, 6'250U);
  EXPECT_EQ(reading.since_edge_ticks, 0U);
  EXPECT_FALSE(reading.edges_known);
  EXPECT_EQ(counted(3, 10'000'000).since_edge_ticks, 1'562U);
  EXPECT_FALSE(counted(2, 11'000'000).capture_valid) << "an axis reversed";
}

TEST_F(LinuxBoardTest, ACountThatIsNoneOrAboveTheCeilingIsAnError) {
  make_ready();
  fake_.write(FakeBoard::count_file(Axis::kY), "none\n");
  EXPECT_EQ(board_.sample(1'000'000).error(), ErrorCode::kDeviceNoData);
  board_.forget_trouble();
  fake_.write(FakeBoard::count_file(Axis::kY), "12 34\n");
  EXPECT_EQ(board_.sample(2'000'000).error(), ErrorCode::kDeviceNoData);
  board_.forget_trouble();
  fake_.write(FakeBoard::count_file(Axis::kY), "4294967296\n");
  EXPECT_EQ(board_.sample(3'000'000).error(), ErrorCode::kDeviceNoData);
  EXPECT_TRUE(board_.trouble().message().ends_with("says 4294967296, not 4294967295"));
}

TEST_F(LinuxBoardTest, ALineThatIsNeitherZeroNorOneIsAnError) {
  make_ready();
  fake_.write(FakeBoard::line_file(Line::kKillSwitch), 7);
  EXPECT_EQ(board_.sample(1'000'000).error(), ErrorCode::kDeviceNoData);
}

TEST_F(LinuxBoardTest, NeverBothChannelsAboveZeroWhenTheDriveReverses) {
  make_ready();
  EhrpwmDriver& pwm = devices_.pwm(Axis::kY);
  ASSERT_TRUE(pwm.write({.channel_a_ticks = 250, .enable = true}));
  ASSERT_TRUE(board_.flush());
  EXPECT_EQ(duty_ns(0), 2'500U);
  EXPECT_EQ(duty_ns(1), 0U);
  EXPECT_EQ(fake_.read(FakeBoard::pwm_file(Axis::kY, 0, "enable")), 1U);
  ASSERT_TRUE(pwm.write({.channel_b_ticks = 100, .enable = true}));
  // The channel that has to fall refuses: the other must not have risen.
  ASSERT_TRUE(board_.flush());
  EXPECT_EQ(duty_ns(0), 0U);
  EXPECT_EQ(duty_ns(1), 1'000U);
}

TEST_F(LinuxBoardTest, AChannelThatWillNotFallKeepsTheOtherDownAndTheRestIsMadeSafe) {
  const auto seal = fake_.sealable(FakeBoard::pwm_file(Axis::kY, 0, "duty_cycle"));
  make_ready();
  EhrpwmDriver& pwm = devices_.pwm(Axis::kY);
  ASSERT_TRUE(pwm.write({.channel_a_ticks = 250, .enable = true}));
  ASSERT_TRUE(board_.flush());
  seal.close_for_writing();
  ASSERT_TRUE(pwm.write({.channel_b_ticks = 100, .enable = true}));
  EXPECT_EQ(board_.flush().error(), ErrorCode::kTransportFailed);
  EXPECT_EQ(duty_ns(1), 0U);
  board_.make_safe();
  EXPECT_EQ(fake_.read(FakeBoard::pwm_file(Axis::kY, 0, "enable")), 0U) << "its enable still works";
  EXPECT_EQ(fake_.read(FakeBoard::line_file(Line::kAmplifierEnableY)), 0U);
}

TEST_F(LinuxBoardTest, ClosingTheDriverPutsNothingOut) {
  make_ready();
  ASSERT_TRUE(devices_.pwm(Axis::kY).write({.channel_b_ticks = 1000, .enable = true}));
  ASSERT_TRUE(board_.flush());
  ASSERT_FALSE(fake_.is_safe());
  ASSERT_TRUE(devices_.pwm(Axis::kY).close());
  EXPECT_TRUE(fake_.is_safe());
}

TEST_F(LinuxBoardTest, AnActiveLowLineIsActiveWhenItsFileSaysZero) {
  LinuxDevices devices = fake_.devices();
  devices.kill_switch = '!' + devices.kill_switch;
  ASSERT_TRUE(board_.open(devices));
  GpioDriver& kill = devices_.line(Line::kKillSwitch);
  ASSERT_TRUE(kill.open());
  ASSERT_TRUE(kill.init({.interrupt_on_edges = true}));
  ASSERT_TRUE(devices_.interrupts().open());
  ASSERT_TRUE(devices_.interrupts().init({}));
  ASSERT_TRUE(board_.sample(1'000'000));
  Aintc::Reading edge;
  ASSERT_TRUE(devices_.interrupts().read(edge));
  EXPECT_EQ(edge.line, Line::kKillSwitch);
  EXPECT_TRUE(edge.active);
  fake_.write(FakeBoard::line_file(Line::kKillSwitch), 1);
  ASSERT_TRUE(board_.sample(2'000'000));
  Gpio::Reading level;
  ASSERT_TRUE(kill.read(level));
  EXPECT_FALSE(level.active);
}

}  // namespace
}  // namespace towbench::bbmc
