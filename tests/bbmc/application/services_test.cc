// reset, quit, config, status and test, typed.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "bbmc/application/commands/command_table.h"
#include "tests/bbmc/application/support/session.h"

namespace towbench::bbmc {
namespace {

using ::testing::AllOf;
using ::testing::EndsWith;
using ::testing::HasSubstr;
using ::testing::Not;
using testing::Session;
using ::testing::StartsWith;

constexpr std::string_view kServiceOk = "ok\r\n";

TEST(Reset, TheKillSwitchLatchesUntilItIsReleasedAndReset) {
  Session session;
  session.calibrate();
  session.type("run --speed 0.2 --distance 0.5\r", 1.5);
  session.machine().set_line(Line::kKillSwitch, true);
  session.run(2);
  EXPECT_THAT(session.heard(),
              EndsWith("stopped: fault 300 kill switch\r\nerror 300: kill switch\r\nbbmc> "));
  EXPECT_THAT(session.enter("run"), StartsWith("error 20"));
  EXPECT_THAT(session.enter("reset"), StartsWith("error 208: "));
  session.machine().set_line(Line::kKillSwitch, false);
  session.run(0.1);
  EXPECT_THAT(session.enter("run"), AllOf(StartsWith("error 204: "), HasSubstr("fault 300")));
  EXPECT_EQ(session.enter("reset"), kServiceOk);
  EXPECT_THAT(session.enter("reset"), HasSubstr("no fault is latched"));
}

TEST(Quit, IsRequestedOnce) {
  Session session;
  EXPECT_FALSE(session.application().quit_requested());
  EXPECT_EQ(session.enter("quit"), kServiceOk);
  EXPECT_TRUE(session.application().quit_requested());
}

TEST(Config, GainsAreTakenInBothUnitsAndShown) {
  Session session;
  EXPECT_THAT(session.enter("config gains y --kp 0.2Nm/rad"), StartsWith("y: kp 0.2Nm/rad, ki "));
  const Configuration& configuration = session.system().configuration();
  EXPECT_EQ(configuration.axes[core::Axis::kY].gains.proportional_Nm_per_rad, 0.2);
  // BBMC 0.5's default for Y: 0.008 % per count. 1 % is 9.88e-4 N m (docs/reference/constants.md),
  // 1 count 2 pi/4000.
  session.enter("config gains y --kp 0.008");
  EXPECT_NEAR(configuration.axes[core::Axis::kY].gains.proportional_Nm_per_rad,
              0.008 * 9.879e-4 / (2 * 3.14159265358979 / 4000), 1e-6);
  EXPECT_THAT(session.enter("config gains y --kp -1"), StartsWith("error 202: "));
  EXPECT_THAT(session.enter("config gains"), StartsWith("error 209: "));
}

TEST(Config, EverythingElseIsShownAndSet) {
  Session session;
  EXPECT_EQ(session.enter("config timers --rate 500"), "control rate 500Hz\r\nok\r\n");
  EXPECT_THAT(session.enter("config timers --rate 0.5"), StartsWith("error 202: "));
  EXPECT_THAT(session.enter("config qei x --velocity period"), StartsWith("x: velocity period, "));
  EXPECT_THAT(session.enter("config law y --feed-forward on"), HasSubstr("feed-forward on"));
  EXPECT_THAT(session.enter("config law y"), HasSubstr("feed-forward on"));
  EXPECT_EQ(session.enter("config law y --friction on --observer on --chain on "
                          "--cross-coupling on --feed-forward off"),
            "y: PID, feed-forward off, friction on, observer on, chain on, cross-coupling on\r\n"
            "ok\r\n");
  EXPECT_THAT(session.enter("config law x"), HasSubstr("friction off, observer off, chain off, "
                                                       "cross-coupling on"));
  EXPECT_THAT(session.enter("config pwm y --period 500 --limit 40%"),
              StartsWith("y: period 500 ticks, duty at most 40%, torque "));
  EXPECT_THAT(session.enter("config pwm y --period 5"), StartsWith("error 202: "));
}

// OR-BBMC-2g: what is set can be read, key by key, as it holds now.
TEST(Config, ShowListsEveryValueWithItsKeyAsItHoldsNow) {
  Session session;
  session.enter("config gains y --kp 0.25Nm/rad");
  session.enter("config pwm x --limit 33%");
  session.enter("config timers --rate 500");
  EXPECT_THAT(session.enter("config show"),
              AllOf(StartsWith("control_rate_Hz = 500\r\n"),
                    HasSubstr("axis.y.gains.proportional_Nm_per_rad = 0.25\r\n"),
                    HasSubstr("axis.y.feed_forward.inertia_kg_m2 = 0.00001714\r\n"),
                    HasSubstr("axis.x.drive.duty_limit_pct = 33\r\n"),
                    HasSubstr("axis.x.velocity.method = hybrid\r\n"),
                    HasSubstr("safety.amplifier_ready_fitted = true\r\n"),
                    HasSubstr("goto.done_within_counts = 0\r\n"), EndsWith("ok\r\n")));
}

TEST(Config, ADutyLimitHoldsFromTheNextMotionOn) {
  Session session;
  session.enter("config pwm y --limit 5%");
  EXPECT_THAT(session.enter("rmpi step y --duty 6%"), StartsWith("error 202: "));
  session.enter("config pwm y --limit 6% --period 2000");
  EXPECT_THAT(session.enter("rmpi step y --duty 6% --time 0.05s --rest 0"), EndsWith("ok\r\n"));
}

TEST(Debug, TellsWhatTheLawDidAfterEachMotionUntilItIsDisabled) {
  Session session;
  session.calibrate();
  session.enter("debug enable");
  EXPECT_THAT(session.enter("run --distance 1cm --speed 0.05"),
              AllOf(HasSubstr("debug y: reference "), HasSubstr("integral "),
                    HasSubstr("debug: ticks "), EndsWith("done\r\nok\r\n")));
  session.enter("debug disable");
  EXPECT_THAT(session.enter("run --distance 1cm --speed 0.05"), Not(HasSubstr("debug")));
}

TEST(Poscalib, FindsTheSwitchAndSaysWhereTheAxisStands) {
  Session session;
  EXPECT_THAT(session.type("poscalib y\r", 2.0), HasSubstr("looking for the min switch"));
  session.machine().set_line(Line::kHallYMin, true);
  session.run(1.0);
  session.machine().set_line(Line::kHallYMin, false);
  session.run(3.0);
  session.machine().set_line(Line::kHallYMin, true);  // the slow approach
  session.run(0.5);
  session.machine().set_line(Line::kHallYMin, false);
  session.run(4.0);
  EXPECT_THAT(session.heard(), AllOf(HasSubstr("y: stands at "), HasSubstr("x: not calibrated"),
                                     EndsWith("done\r\nok\r\nbbmc> ")));
  EXPECT_TRUE(session.status().axes[core::Axis::kY].position_calibrated);
}

TEST(Poscalib, IsRefusedWhereThereIsNoWayOff) {
  Session session;
  session.machine().set_line(Line::kHallXMin, true);
  session.machine().set_line(Line::kHallXMax, true);
  session.run(0.01);
  EXPECT_THAT(session.enter("poscalib x"), AllOf(StartsWith("error 206: "), HasSubstr("both")));
}

TEST(Poscalib, AStuckSwitchIsALatchedFault) {
  Session session;
  session.machine().set_line(Line::kHallYMin, true);
  session.run(0.01);
  EXPECT_THAT(session.enter("poscalib y"),
              AllOf(HasSubstr("stopped: fault 301 end-stop min"), HasSubstr("error 301")));
  EXPECT_FALSE(session.status().axes[core::Axis::kY].position_calibrated);
}

TEST(Status, TellsTheStateOfEverything) {
  Session session;
  session.calibrate();
  EXPECT_THAT(session.enter("status"),
              AllOf(HasSubstr("fault: none, kill switch released"),
                    HasSubstr("axis y: idle, position 600000 counts = "), HasSubstr("(calibrated)"),
                    HasSubstr("axis x: "), HasSubstr("end-stop min clear")));
}

TEST(TestCommand, ShowsLinesRegistersAndDevices) {
  Session session;
  session.machine().set_line(Line::kHallXMax, true);
  EXPECT_THAT(session.enter("test gpio"),
              AllOf(HasSubstr("hall_x_max    in   active\r\n"),
                    HasSubstr("kill_switch   in   inactive\r\n"), EndsWith("ok\r\n")));
  EXPECT_THAT(session.enter("test qei y"), AllOf(HasSubstr("position "), EndsWith("ok\r\n")));
  EXPECT_EQ(session.enter("test pwm x"),
            "channel A 0 ticks, B 0 of 1000, output disabled\r\nok\r\n");
  const std::string devices = session.enter("test devices");
  EXPECT_EQ(static_cast<std::size_t>(std::count(devices.begin(), devices.end(), '\n')),
            DeviceManager::kUnitCount + 1);
  EXPECT_THAT(devices, Not(HasSubstr("closed")));
}

}  // namespace
}  // namespace towbench::bbmc
