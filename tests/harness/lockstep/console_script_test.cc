#include "harness/lockstep/console_script.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace towbench::harness {
namespace {

using ::testing::HasSubstr;
using Progress = ConsoleScript::Progress;
using Steps = std::vector<ConsoleStep>;

constexpr core::Nanoseconds kMs = core::kNanosecondsPerMillisecond;

std::string take(ConsoleScript& script, core::Nanoseconds now_ns) {
  const std::string text(script.pending(now_ns));
  script.typed(text.size());
  return text;
}

// One turn as the bench does it: type, hear, update.
Progress turn(ConsoleScript& script, core::Nanoseconds now_ns, std::string_view heard,
              bool idle = true) {
  (void)take(script, now_ns);
  script.hear(heard);
  return script.update(now_ns, idle);
}

TEST(ConsoleScript, AnEmptyScriptIsDoneAtOnce) {
  ConsoleScript script(Steps{});
  EXPECT_EQ(turn(script, 0, ""), Progress::kDone);
}

TEST(ConsoleScript, TypesWithACarriageReturnAndWaitsForTheAnswer) {
  ConsoleScript script(Steps{{.send = "status", .expect = "ok"}});
  EXPECT_EQ(turn(script, 0, ""), Progress::kRunning);
  EXPECT_EQ(take(script, kMs), "status\r");
  EXPECT_EQ(turn(script, kMs, "bbmc> status\r\n"), Progress::kRunning);
  EXPECT_EQ(turn(script, 2 * kMs, "ok\r\n"), Progress::kDone);
}

TEST(ConsoleScript, ItsOwnEchoIsNoAnswer) {
  ConsoleScript script(Steps{{.send = "say ok", .expect = "ok", .timeout_s = 0.01}});
  EXPECT_EQ(turn(script, 0, ""), Progress::kRunning);
  EXPECT_EQ(turn(script, kMs, "say ok\r\n"), Progress::kRunning);
  EXPECT_EQ(turn(script, 20 * kMs, "no\r\n"), Progress::kFailed);
}

TEST(ConsoleScript, AnAnswerFromBeforeTheCommandDoesNotCount) {
  ConsoleScript script(Steps{{.send = "a", .expect = "ok"}, {.send = "b", .expect = "ok"}});
  turn(script, 0, "");
  EXPECT_EQ(turn(script, kMs, "a\r\nok\r\n"), Progress::kRunning);
  EXPECT_EQ(turn(script, 2 * kMs, "b\r\n"), Progress::kRunning);
  EXPECT_EQ(turn(script, 3 * kMs, "ok\r\n"), Progress::kDone);
}

TEST(ConsoleScript, ARefusalThatNobodyExpectedFailsAtOnceWithItsWords) {
  ConsoleScript script(Steps{{.send = "run", .expect = "done", .timeout_s = 100}});
  turn(script, 0, "");
  EXPECT_EQ(turn(script, kMs, "run\r\nerror 207: too fast\r\n"), Progress::kFailed);
  EXPECT_THAT(script.failure(), HasSubstr("step 1 (run)"));
  EXPECT_THAT(script.failure(), HasSubstr("error 207: too fast"));
}

TEST(ConsoleScript, AnExpectedRefusalPasses) {
  ConsoleScript script(Steps{{.send = "run", .expect = "error 204"}});
  turn(script, 0, "");
  EXPECT_EQ(turn(script, kMs, "run\r\nerror 204: fault latched\r\n"), Progress::kDone);
}

TEST(ConsoleScript, SilenceFailsAfterTheTimeOutAndNotBefore) {
  ConsoleScript script(Steps{{.send = "a", .expect = "ok", .timeout_s = 1.0}});
  turn(script, 0, "");
  EXPECT_EQ(turn(script, kMs, ""), Progress::kRunning);
  EXPECT_EQ(turn(script, 1000 * kMs, ""), Progress::kRunning);
  EXPECT_EQ(turn(script, 1001 * kMs, ""), Progress::kFailed);
  EXPECT_THAT(script.failure(), HasSubstr("did not come within 1 s"));
}

TEST(ConsoleScript, NothingIsTypedBeforeItsTime) {
  ConsoleScript script(Steps{{.at_s = 0.5, .send = "a"}});
  EXPECT_EQ(turn(script, 499 * kMs, ""), Progress::kRunning);
  EXPECT_EQ(take(script, 499 * kMs), "");
  EXPECT_EQ(turn(script, 500 * kMs, ""), Progress::kRunning);
  EXPECT_EQ(take(script, 501 * kMs), "a\r");
}

TEST(ConsoleScript, WaitsForRestAndThenPauses) {
  ConsoleScript script(Steps{{.send = "a", .wait_idle = true, .wait_s = 0.01}});
  turn(script, 0, "", false);
  EXPECT_EQ(turn(script, 1 * kMs, "", false), Progress::kRunning);
  EXPECT_EQ(turn(script, 5 * kMs, "", true), Progress::kRunning);
  EXPECT_EQ(turn(script, 14 * kMs, "", true), Progress::kRunning);
  EXPECT_EQ(turn(script, 15 * kMs, "", true), Progress::kDone);
}

TEST(ConsoleScript, AMachineThatNeverRestsFailsAfterTheTimeOut) {
  ConsoleScript script(Steps{{.send = "a", .wait_idle = true, .timeout_s = 1.0}});
  turn(script, 0, "", false);
  turn(script, kMs, "", false);
  EXPECT_EQ(turn(script, 1001 * kMs, "", false), Progress::kFailed);
  EXPECT_THAT(script.failure(), HasSubstr("rest"));
}

TEST(ConsoleScript, AUartThatTakesOneByteAtATimeGetsTheWholeLine) {
  ConsoleScript script(Steps{{.send = "abc"}});
  (void)script.update(0, true);
  std::string taken;
  for (int i = 0; i < 10 && script.update(kMs * i, true) == Progress::kRunning; ++i) {
    taken += script.pending(0).substr(0, 1);
    script.typed(std::min<std::size_t>(1, script.pending(0).size()));
  }
  EXPECT_EQ(taken, "abc\r");
}

}  // namespace
}  // namespace towbench::harness
