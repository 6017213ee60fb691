// Every command, typed.
#include <fstream>
#include <iterator>
#include <sstream>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "bbmc/application/commands/command_table.h"
#include "tests/bbmc/application/support/session.h"

namespace towbench::bbmc {
namespace {

using ::testing::AllOf;
using ::testing::EndsWith;
using ::testing::HasSubstr;
using ::testing::MatchesRegex;
using ::testing::Not;
using testing::Session;
using ::testing::StartsWith;

constexpr std::string_view kOk = "ok\r\n";

double count_of(Session& session, core::Axis axis) {
  return static_cast<double>(session.status().axes[axis].count);
}

TEST(Console, GreetsAndPrompts) {
  Session session;
  EXPECT_EQ(session.type("\r", 0.01), "bbmc> ");
}

TEST(Console, EveryCommandEndsWithOneLineThatSaysHowItWent) {
  for (const std::string_view line :
       {"status", "help", "help all", "help run", "perf print", "perf reset", "datalog reset",
        "config timers", "reset", "nonsense", "datalog print", "goto 1 2", "run --speed"}) {
    Session session;
    const std::string reply = session.enter(line);
    std::istringstream lines(reply);
    int verdicts = 0;
    std::string text;
    std::string last;
    while (std::getline(lines, text)) {
      last = text;
      verdicts += text == "ok\r" || text.starts_with("error ") ? 1 : 0;
    }
    EXPECT_EQ(verdicts, 1) << line << ": " << reply;
    EXPECT_TRUE(last == "ok\r" || last.starts_with("error ")) << line << ": " << reply;
  }
}

TEST(Console, EchoesWhatIsTypedUntilItIsSwitchedOff) {
  Session session;
  session.enter("config console --echo on");
  EXPECT_THAT(session.type("statux\bs\r", 0.05), StartsWith("statux\r\x1b[Kbbmc> status\r\n"));
  EXPECT_THAT(session.type("config console --echo off\rperf reset\r", 0.05),
              EndsWith("off\r\nok\r\nbbmc> ok\r\nbbmc> "));
}

TEST(Run, ATrapezoidGoesItsDistanceAndSaysDone) {
  Session session;
  session.calibrate();
  const double before = count_of(session, core::Axis::kY);
  const std::string reply =
      session.enter("run -trapez y --speed 0.3m/s --distance 50cm --wait 100ms");
  EXPECT_THAT(reply, AllOf(StartsWith("moving for 2.07s\r\n"), EndsWith("done\r\nok\r\n")));
  EXPECT_NEAR(count_of(session, core::Axis::kY) - before, 0.5 * 445'345, 500);
  EXPECT_NEAR(count_of(session, core::Axis::kX), 250'000, 50);
}

TEST(Run, TheShortestFormsMeanWhatTheyMeantInBbmc05) {
  Session session;
  session.calibrate();
  // Trapezoid on Y, 2 m at 0.1 m/s, 0.3 s, after 0.5 s.
  EXPECT_THAT(session.enter("run"), StartsWith("moving for 20.80s\r\n"));
  EXPECT_THAT(session.enter("run --distance -2 --speed 0.4"), StartsWith("moving for 5.80s\r\n"));
}

TEST(Run, ACircleComesBackToWhereItBegan) {
  Session session;
  session.calibrate();
  const std::string reply = session.enter("run -circle --radius 5cm --period 4s --turns 1");
  EXPECT_THAT(reply, AllOf(StartsWith("moving for 5.50s\r\n"), EndsWith("done\r\nok\r\n")));
  EXPECT_NEAR(count_of(session, core::Axis::kY), 600'000, 500);
  EXPECT_NEAR(count_of(session, core::Axis::kX), 250'000, 500);
  // On its way it was there: both rows of the log reach across the circle.
  double farthest = 0;
  for (const DataLogRow& row : session.system().data_log().rows()) {
    farthest = std::max(farthest, static_cast<double>(row.axes[core::Axis::kY].count));
  }
  EXPECT_NEAR(farthest - 600'000, 0.1 * 445'345, 500);
}

TEST(Run, AnEllipseReachesItsTwoExtents) {
  Session session;
  session.calibrate();
  EXPECT_THAT(session.enter("run -ellipse --radius-y 4cm --radius-x 2cm --period 4s --turns 1"),
              EndsWith("done\r\nok\r\n"));
  double y_most = 0;
  double x_most = 0;
  for (const DataLogRow& row : session.system().data_log().rows()) {
    y_most = std::max(y_most, row.axes[core::Axis::kY].reference_count - 600'000);
    x_most = std::max(x_most, row.axes[core::Axis::kX].reference_count - 250'000);
  }
  EXPECT_NEAR(y_most, 0.08 * 445'345, 20);
  EXPECT_NEAR(x_most, 0.02 * 742'241, 20);
}

TEST(Run, ASpatialSinusoidEndsOnBothAxesAtOnce) {
  Session session;
  session.calibrate();
  EXPECT_THAT(session.enter("run -spatial --distance 40cm --speed 0.1 --amplitude 2cm --waves 3"),
              AllOf(StartsWith("moving for 5.00s"), EndsWith("done\r\nok\r\n")));
  EXPECT_NEAR(count_of(session, core::Axis::kY) - 600'000, 0.4 * 445'345, 500);
  EXPECT_NEAR(count_of(session, core::Axis::kX), 250'000, 500);
  int crossings = 0;
  double before = 0;
  for (const DataLogRow& row : session.system().data_log().rows()) {
    const double x = row.axes[core::Axis::kX].reference_count - 250'000;
    if (std::fabs(x) > 100) {
      crossings += before * x < 0 ? 1 : 0;
      before = x;
    }
  }
  EXPECT_EQ(crossings, 5);  // three swings cross the middle twice each, the last time at the end
}

TEST(Path, RunsStraightThroughItsPointsAndRestsInEach) {
  Session session;
  session.calibrate();
  EXPECT_THAT(session.enter("run -path"), StartsWith("error 203: "));
  EXPECT_EQ(session.enter("path add 640000 250000"), kOk);
  EXPECT_EQ(session.enter("path add 620000 280000"), kOk);
  EXPECT_EQ(session.enter("path add 1.4m 0.35m"), kOk);
  EXPECT_THAT(session.enter("path print"), HasSubstr("3 points"));
  EXPECT_THAT(session.enter("run -path --speed 0.1m/s --dwell 0.2s"), EndsWith("done\r\nok\r\n"));
  EXPECT_NEAR(count_of(session, core::Axis::kY), 1.4 * 445'345, 200);
  EXPECT_NEAR(count_of(session, core::Axis::kX), 0.35 * 742'241, 200);
  // On the second line both axes are at the same share of it: x against y is a straight line.
  for (const DataLogRow& row : session.system().data_log().rows()) {
    const double y = row.axes[core::Axis::kY].reference_count;
    const double x = row.axes[core::Axis::kX].reference_count;
    if (x > 279'999) {
      break;
    }
    if (y < 639'999 && x > 250'001) {
      ASSERT_NEAR((x - 250'000) / 30'000, (640'000 - y) / 20'000, 1e-6);
    }
  }
  EXPECT_EQ(session.enter("path clear"), kOk);
  for (std::size_t i = 0; i < kMaxWayPoints; ++i) {
    EXPECT_EQ(session.enter("path add 600000 250000"), kOk);
  }
  EXPECT_THAT(session.enter("path add 600000 250000"), StartsWith("error 202: "));
}

TEST(Run, AskingForValuesTakesAnswersAndDefaults) {
  Session session;
  session.calibrate();
  session.enter("run -trapez -traject");
  session.enter("0.25");                        // distance
  session.enter("250mm/s");                     // speed
  const std::string reply = session.enter("");  // acceleration: as offered
  EXPECT_THAT(reply, AllOf(StartsWith("moving for 1.80s"), EndsWith("done\r\nok\r\n")));
}

TEST(Run, ARefusedAnswerEndsTheCommandAndChangesNothing) {
  Session session;
  session.calibrate();
  const PidGains before = session.system().configuration().axes[core::Axis::kY].gains;
  session.enter("run -contrl --speed 0.2");
  session.enter("0.01");
  EXPECT_THAT(session.enter("many"), StartsWith("error 201: "));
  EXPECT_EQ(session.system().configuration().axes[core::Axis::kY].gains, before);
  EXPECT_TRUE(session.system().at_rest());
  EXPECT_EQ(session.status().motions_ended, 0);
  EXPECT_EQ(session.enter("perf reset"), kOk);
}

TEST(Goto, GoesToBothPlacesInCountsOrMetres) {
  Session session;
  session.calibrate();
  EXPECT_THAT(session.enter("goto 640000 240000 -f"), EndsWith("done\r\nok\r\n"));
  EXPECT_NEAR(count_of(session, core::Axis::kY), 640'000, 1);
  EXPECT_NEAR(count_of(session, core::Axis::kX), 240'000, 1);
  EXPECT_THAT(session.enter("goto 1.40m 0.33m"), EndsWith("done\r\nok\r\n"));
  EXPECT_NEAR(session.status().axes[core::Axis::kY].position_m, 1.40, 5e-6);
  EXPECT_NEAR(session.status().axes[core::Axis::kX].position_m, 0.33, 5e-6);
}

TEST(Goto, IsRefusedBeforeCalibrationAndSaysWhatToDo) {
  Session session;
  EXPECT_THAT(session.enter("goto home"), AllOf(StartsWith("error 205: position is not calibrated"),
                                                HasSubstr("reset poscalib DOF POSITION")));
}

TEST(Rmpi, PulsesMoveTheAxisAndTheLogShowsTheirDutyAndNoOther) {
  Session session;
  session.calibrate();
  const std::string reply = session.enter("rmpi si y -a 5 -p 200 300 --pulses 3 -d -");
  EXPECT_THAT(reply, AllOf(StartsWith("moving for 3.00s\r\n"), EndsWith("done\r\nok\r\n")));
  int on = 0;
  for (const DataLogRow& row : session.system().data_log().rows()) {
    const auto duty_pct = static_cast<double>(row.axes[core::Axis::kY].duty_pct);
    ASSERT_TRUE(std::fabs(duty_pct) < 1e-6 || std::fabs(duty_pct + 5) < 0.06) << duty_pct;
    on += duty_pct < -1 ? 1 : 0;
  }
  EXPECT_NEAR(on, 600, 3);
  EXPECT_LT(count_of(session, core::Axis::kY), 600'000);
}

TEST(Rmpi, EveryOtherExcitationRunsToItsEnd) {
  for (const std::string_view line :
       {"rmpi step y --duty 5% --time 0.2s --wait 0", "rmpi dstep y -a 5 --second-duty -5",
        "rmpi sine y -a 4 --frequency 3Hz --cycles 4",
        "rmpi si y --signal prbs -a 4 --order 5 --bit 20ms"}) {
    Session session;
    session.calibrate();
    EXPECT_THAT(session.enter(line), EndsWith("done\r\nok\r\n")) << line;
    double most_pct = 0;
    for (const DataLogRow& row : session.system().data_log().rows()) {
      if (row.axes[core::Axis::kY].mode == AxisMode::kOpenLoop) {
        most_pct =
            std::max(most_pct, std::fabs(static_cast<double>(row.axes[core::Axis::kY].duty_pct)));
      }
    }
    EXPECT_NEAR(most_pct, line.find("-a 4") == std::string_view::npos ? 5 : 4, 0.06) << line;
  }
}

TEST(Rmpi, BreakAwaySaysWhereAndWithWhat) {
  Session session;
  session.calibrate();
  EXPECT_THAT(session.enter("rmpi break y"),
              AllOf(HasSubstr("broke away at 600"), EndsWith("done\r\nok\r\n")));
  EXPECT_THAT(session.enter("rmpi break y --limit 1% --increment 0.5 -d -"),
              AnyOf(HasSubstr("did not break away"), HasSubstr("broke away")));
}

TEST(DataLog, PrintsWhatWasRecordedBetweenItsMarks) {
  Session session;
  session.calibrate();
  EXPECT_THAT(session.enter("datalog print"), HasSubstr("the data log is empty"));
  session.enter("run --speed 0.2 --distance 0.1 --wait 0");
  const std::size_t rows = session.system().data_log().rows().size();
  const std::string reply = session.enter("datalog print y");
  EXPECT_THAT(reply, AllOf(StartsWith(std::to_string(rows) + " rows\r\n"),
                           HasSubstr("DATALOG_BEGIN: y\r\nindex,time_s,status,count,"),
                           EndsWith("DATALOG_END\r\nok\r\n"), Not(HasSubstr("DATALOG_BEGIN: x"))));
  EXPECT_EQ(static_cast<std::size_t>(std::count(reply.begin(), reply.end(), '\n')), rows + 5);
  const std::string both = session.enter("datalog print");
  EXPECT_THAT(both, HasSubstr("DATALOG_END\r\nDATALOG_BEGIN: x\r\n"));
  EXPECT_EQ(session.enter("datalog reset"), kOk);
  EXPECT_THAT(session.enter("datalog print"), HasSubstr("error 203"));
}

TEST(DataLog, ASlowUartDelaysTheListingButLosesNothing) {
  Session session;
  session.calibrate();
  session.enter("run --speed 0.2 --distance 0.1 --wait 0");
  const std::string whole = session.enter("datalog print");
  session.machine().uart_room = 64;
  session.machine().to_controller = "datalog print\r";
  std::string pieces;
  while (!pieces.ends_with("bbmc> ")) {
    session.run(0.001);
    const std::string piece = session.heard();
    ASSERT_LE(piece.size(), 64U);
    ASSERT_FALSE(piece.empty());
    pieces += piece;
  }
  EXPECT_EQ(pieces, whole + "bbmc> ");
}

TEST(DataLog, AListingCanBeInterruptedAndIsThenNoSuccess) {
  Session session;
  session.calibrate();
  session.enter("run --speed 0.2 --distance 0.1 --wait 0");
  session.machine().uart_room = 64;
  session.type("datalog print\r", 0.003);
  session.machine().to_controller = "\x03";
  std::string rest;
  for (int i = 0; i < 100; ++i) {
    session.run(0.001);
    rest += session.heard();
  }
  EXPECT_THAT(rest, AllOf(EndsWith("error 203: not possible in this state: interrupted\r\nbbmc> "),
                          Not(HasSubstr("DATALOG_END"))));
}

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

TEST(Console, ControlCStopsAMotionAndForgetsWhatWasTypedAhead) {
  Session session;
  session.calibrate();
  session.type("run --speed 0.2 --distance 1\r", 1.5);
  EXPECT_FALSE(session.application().idle());
  const std::string reply = session.type("goto home\r\x03", 1.5);
  EXPECT_THAT(reply, EndsWith("stopped: on request\r\nok\r\nbbmc> "));
  EXPECT_TRUE(session.application().idle());
  EXPECT_TRUE(session.system().at_rest());
  EXPECT_LT(count_of(session, core::Axis::kY), 600'000 + 445'345.0 / 2);
}

TEST(Console, WhatIsTypedAheadOfAMotionIsServedAfterIt) {
  Session session;
  session.calibrate();
  const std::string reply =
      session.enter("run --speed 0.3 --distance 0.2\rgoto 600000 250000\rperf reset");
  EXPECT_THAT(reply, MatchesRegex("moving for .*done\r\nok\r\nbbmc> (moving.*)?done\r\nok\r\n"
                                  "bbmc> ok\r\n"));
  EXPECT_NEAR(count_of(session, core::Axis::kY), 600'000, 1);
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

// Defect 12: whatever is refused, everything is as it was.
TEST(Defect12, ARefusedArgumentChangesNothing) {
  Session session;
  session.calibrate();
  const auto picture = [&] {
    const Configuration& c = session.system().configuration();
    std::ostringstream text;
    for (const core::Axis axis : core::kAxes) {
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

TEST(Help, KnowsEveryCommandAndEveryOption) {
  Session session;
  const std::string list = session.enter("help");
  const std::string all = session.enter("help all");
  for (const CommandSpec& command : command_table()) {
    const std::string sub =
        command.is_default ? "[" + std::string(command.sub) + "]" : std::string(command.sub);
    const std::string title =
        "  " + std::string(command.word) + (command.sub.empty() ? "" : " " + sub);
    EXPECT_THAT(list, HasSubstr(title));
    EXPECT_THAT(all, HasSubstr(title));
    const std::string one = session.enter("help " + std::string(command.word));
    EXPECT_THAT(one, HasSubstr(title));
    for (const OptionSpec& option : command.options) {
      EXPECT_THAT(one, HasSubstr("    " + std::string(option.name)));
      EXPECT_FALSE(option.meaning.empty()) << option.name;
    }
  }
}

TEST(Help, EveryDefaultIsInsideItsRangeAndEveryBareUnitExists) {
  for (const CommandSpec& command : command_table()) {
    for (const OptionSpec& option : command.options) {
      if (option.kind != OptionKind::kQuantity) {
        continue;
      }
      EXPECT_TRUE(option.presence != Presence::kDefault || !option.default_text.empty() ||
                  option.range.contains(option.default_value))
          << command.word << ' ' << option.name;
      const auto by_text =
          parse_quantity(option.default_text, option.dimension, option.bare_unit, 445'345);
      EXPECT_TRUE(option.default_text.empty() || (by_text && option.range.contains(*by_text)))
          << command.word << ' ' << option.name;
      EXPECT_NE(find_unit(option.dimension, option.bare_unit), nullptr)
          << command.word << ' ' << option.name;
    }
  }
}

TEST(Readme, ShowsWhatHelpAllPrints) {
  Session session;
  std::string help = session.enter("help all");
  std::erase(help, '\r');
  help.resize(help.size() - std::string_view("ok\n").size());
  std::ifstream file("bbmc/application/README.md");
  ASSERT_TRUE(file) << "tests run in the root of the sources";
  std::string line;
  while (line != "```text") {
    ASSERT_TRUE(std::getline(file, line));
  }
  std::istringstream printed(help);
  for (std::string expected; std::getline(printed, expected);) {
    ASSERT_TRUE(std::getline(file, line));
    ASSERT_EQ(line, expected);
  }
  ASSERT_TRUE(std::getline(file, line));
  EXPECT_EQ(line, "```");
}

}  // namespace
}  // namespace towbench::bbmc
