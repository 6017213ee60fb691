// How late a controller is by a clock that does not wait, on times that are given.
#include "harness/external/answer_watch.h"

#include <memory>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace towbench::harness {
namespace {

using ::testing::HasSubstr;

constexpr core::Nanoseconds kMicro_ns = core::kNanosecondsPerMicrosecond;
constexpr core::Nanoseconds kTurn_ns = core::kNanosecondsPerMillisecond;
constexpr core::Nanoseconds kPlantTicks_ns = 100 * kMicro_ns;

// Turns of a millisecond; the answer to what is told at `slow_ms` takes `slow_ns`.
std::unique_ptr<AnswerWatch> answered(core::Nanoseconds usual_ns, int slow_ms,
                                      core::Nanoseconds slow_ns, int drives_from_ms = 0) {
  auto watch = std::make_unique<AnswerWatch>(kTurn_ns);
  core::Nanoseconds next_ns = kTurn_ns;  // what is answered next
  for (core::Nanoseconds now_ns = 0; now_ns < 100 * kTurn_ns; now_ns += kPlantTicks_ns) {
    const auto takes_ns = next_ns == slow_ms * kTurn_ns ? slow_ns : usual_ns;
    if (now_ns >= next_ns + takes_ns) {
      watch->answered(next_ns + kTurn_ns, now_ns);
      next_ns += kTurn_ns;
    }
    watch->tick(now_ns, now_ns >= drives_from_ms * kTurn_ns);
  }
  return watch;
}

TEST(AnswerWatch, AnswersInTimeHaveTheirLatencyAndPass) {
  const auto watch = answered(3 * kPlantTicks_ns, 50, 3 * kPlantTicks_ns);
  EXPECT_EQ(watch->latency().max_ns(), 3 * kPlantTicks_ns);
  EXPECT_EQ(watch->latency().count(), 99U);
  EXPECT_EQ(controller_on_time(*watch).verdict, Verdict::kPass);
}

TEST(AnswerWatch, AnAnswerOfOneExchangeIsTheLastThatCounts) {
  EXPECT_EQ(controller_on_time(*answered(kPlantTicks_ns, 50, 10 * kPlantTicks_ns)).verdict,
            Verdict::kPass);
  const auto check = controller_on_time(*answered(kPlantTicks_ns, 50, 12 * kPlantTicks_ns));
  EXPECT_EQ(check.verdict, Verdict::kInvalid);
  EXPECT_THAT(check.reason, HasSubstr("at 0.0500 s"));
  EXPECT_NEAR(*check.value, 1.1e-3, 1e-9);
}

TEST(AnswerWatch, NothingIsAtStakeBeforeTheFirstDrive) {
  EXPECT_EQ(controller_on_time(*answered(kPlantTicks_ns, 50, 40 * kPlantTicks_ns, 60)).verdict,
            Verdict::kPass);
  EXPECT_EQ(controller_on_time(*answered(kPlantTicks_ns, 50, 40 * kPlantTicks_ns, 40)).verdict,
            Verdict::kInvalid);
}

TEST(AnswerWatch, OneThatKeepsAClockOfItsOwnIsThereByWhatItSends) {
  for (const auto gap : {10, 20, 21}) {
    AnswerWatch watch(kTurn_ns);
    for (core::Nanoseconds now_ns = 0; now_ns < 100 * kTurn_ns; now_ns += kPlantTicks_ns) {
      const auto tick = now_ns / kPlantTicks_ns;
      if (tick % 10 == 0 && !(tick > 500 && tick < 500 + gap)) {
        watch.heard(now_ns);
      }
      watch.tick(now_ns, true);
    }
    EXPECT_EQ(watch.most_behind_ns() > watch.limit_ns(), gap > 20) << gap;
  }
}

TEST(AnswerWatch, TimesOfTheFutureOrThePastAnswerNothing) {
  AnswerWatch watch(kTurn_ns);
  watch.answered(1000 * kTurn_ns, 2 * kTurn_ns);
  watch.answered(kTurn_ns, 3 * kTurn_ns);
  watch.tick(9 * kTurn_ns, true);
  EXPECT_EQ(watch.most_behind_ns(), 6 * kTurn_ns);
}

TEST(AnswerWatch, NoAnswerIsNoEvidence) {
  const AnswerWatch watch(kTurn_ns);
  EXPECT_EQ(controller_on_time(watch).verdict, Verdict::kInvalid);
}

TEST(AnswerWatch, LongExchangesMayTakeOne) {
  EXPECT_EQ(AnswerWatch(kTurn_ns).limit_ns(), kTurn_ns);
  EXPECT_EQ(AnswerWatch(2 * kTurn_ns).limit_ns(), 2 * kTurn_ns);
  EXPECT_EQ(AnswerWatch(kTurn_ns / 4).limit_ns(), 2 * kTurn_ns - kTurn_ns / 4);
}

}  // namespace
}  // namespace towbench::harness
