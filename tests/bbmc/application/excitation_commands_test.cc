// rmpi and the data log, typed.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

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

double excited_count(Session& session, core::Axis axis) {
  return static_cast<double>(session.status().axes[axis].count);
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
  EXPECT_LT(excited_count(session, core::Axis::kY), 600'000);
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

}  // namespace
}  // namespace towbench::bbmc
