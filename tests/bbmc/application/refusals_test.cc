// What a command refuses, and that nothing has changed then.
#include <sstream>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/bbmc/application/support/session.h"

namespace towbench::bbmc {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;
using testing::Session;
using ::testing::StartsWith;

// Defect 12: whatever is refused, everything is as it was.
TEST(Defect12, ARefusedArgumentChangesNothing) {
  Session session;
  session.calibrate();
  const auto picture = [&] {
    const Configuration& c = session.system().configuration();
    std::ostringstream text;
    for (const core::Axis axis : core::kPlanarAxes) {
      text << c.axes[axis].gains.proportional_Nm_per_rad << ' '
           << c.axes[axis].gains.integral_Nm_per_rad_s << ' '
           << c.axes[axis].gains.derivative_Nm_s_per_rad << ' '
           << static_cast<int>(c.axes[axis].velocity.method) << ' '
           << c.axes[axis].feed_forward.enabled << ' ' << session.status().axes[axis].count << ' '
           << session.status().axes[axis].position_calibrated << ' '
           << session.system().data_log().enabled(axis) << ' ';
    }
    text << c.control_rate_Hz << ' ' << session.status().motions_ended;
    return text.str();
  };
  const std::string before = picture();
  for (const std::string_view line : {
           "run --speed 9m/s",
           "run --speed 0.2 --speed 0.3",
           "run --kp 0.5 --speed nonsense",
           "run --kp 0.5 --distance 3.9m",
           "run -trapez -circle",
           "run z",
           "run y x",
           "run --speed 0.2Hz",
           "run --distance 0",
           "run --distance",
           "run -circle --radius 0.31",
           "run -circle --frequency 0.2 --period 7",
           "run -circle --kp-y 1 --turns 0",
           "run -sinus --amplitude 0",
           "run --nosuch 1",
           "goto 600000",
           "goto 600000 250000 1",
           "goto 1e9 250000",
           "goto nowhere 250000",
           "rmpi si",
           "rmpi si y -a 0",
           "rmpi si y -a 101",
           "rmpi si y -p 200",
           "rmpi si y --pulses 2.5",
           "rmpi si y --pulses 0",
           "rmpi si y --pulses 3 --duration 2",
           "rmpi break y --increment 0",
           "rmpi nothing y",
           "rmpi",
           "datalog",
           "datalog disable z",
           "config gains y --kp 0.5 --ki -1",
           "config gains y --kp 0.5Nm",
           "config timers --rate 6000",
           "config timers --rate 999",
           "config qei y --velocity guess",
           "config law x --feed-forward maybe",
           "config nothing",
           "reset poscalib",
           "reset poscalib y",
           "reset poscalib y 1 --forget",
           "reset poscalib y 1e300",
           "reset poscalib y here",
           "reset everything now",
           "help me",
           "\x02",
           "run \xff",
       }) {
    const std::string reply = session.enter(line);
    EXPECT_THAT(reply, StartsWith("error 20")) << line;
    EXPECT_EQ(picture(), before) << line;
  }
}

TEST(Refusal, NamesTheArgumentWhatWasGivenAndWhatIsAllowed) {
  Session session;
  session.calibrate();
  EXPECT_EQ(session.enter("run --speed 9m/s"),
            "error 202: argument out of range: --speed 9m/s is not 0.0001m/s .. 0.7m/s\r\n");
  EXPECT_EQ(session.enter("run --speed fast"),
            "error 201: bad argument: --speed fast is not 0.0001m/s .. 0.7m/s\r\n");
  EXPECT_EQ(session.enter("rmpi si"), "error 209: missing argument: DOF: y (or 1), x (or 2)\r\n");
  EXPECT_EQ(session.enter("rmpi si y --duty 0%"),
            "error 202: argument out of range: --duty 0% is not above 0% to 100%\r\n");
  EXPECT_EQ(session.enter("fly"),
            "error 200: unknown command: fly; `help` lists what there is\r\n");
  EXPECT_EQ(session.enter("run --sped 1"), "error 201: bad argument: no such option: --sped\r\n");
  EXPECT_THAT(session.enter("run --speed 0.7 --distance 1"),
              AllOf(StartsWith("error 207: "), HasSubstr("y here at most ")));
}

}  // namespace
}  // namespace towbench::bbmc
