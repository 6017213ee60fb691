// The console as a person meets it: prompt, echo, answers, interruption.
#include <sstream>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/bbmc/application/support/session.h"

namespace towbench::bbmc {
namespace {

using ::testing::EndsWith;
using ::testing::MatchesRegex;
using testing::Session;
using ::testing::StartsWith;

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

}  // namespace
}  // namespace towbench::bbmc
