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

constexpr std::string_view kOk = "ok\r\n";

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
  EXPECT_EQ(session.enter("reset"), kOk);
  EXPECT_THAT(session.enter("reset"), HasSubstr("no fault is latched"));
}

TEST(Quit, IsRequestedOnce) {
  Session session;
  EXPECT_FALSE(session.application().quit_requested());
  EXPECT_EQ(session.enter("quit"), kOk);
  EXPECT_TRUE(session.application().quit_requested());
}

TEST(Config, GainsAreTakenInBothUnitsAndShown) {
  Session session;
  EXPECT_THAT(session.enter("config gains y --kp 0.2Nm/rad"), StartsWith("y: kp 0.2Nm/rad, ki "));
  const Configuration& configuration = session.system().configuration();
  EXPECT_EQ(configuration.axes[core::Axis::kY].gains.proportional_Nm_per_rad, 0.2);
  // BBMC 0.5's default for Y: 0.008 % per count. 1 % is 9.88e-4 N m (plant.md), 1 count 2 pi/4000.
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
  const std::string devices = session.enter("test devices");
  EXPECT_EQ(static_cast<std::size_t>(std::count(devices.begin(), devices.end(), '\n')),
            DeviceManager::kUnitCount + 1);
  EXPECT_THAT(devices, Not(HasSubstr("closed")));
}

}  // namespace
}  // namespace towbench::bbmc
