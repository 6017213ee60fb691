#include "harness/realtime/realtime_checks.h"

#include <memory>

#include <gtest/gtest.h>

#include "tests/harness/realtime/scripted_clock.h"

namespace towbench::harness {
namespace {

constexpr core::Nanoseconds kUs = core::kNanosecondsPerMicrosecond;
constexpr core::Nanoseconds kTickMs = core::kNanosecondsPerMillisecond;

struct Host {
  core::Nanoseconds usual_late_ns = 5 * kUs;
  core::Nanoseconds rare_late_ns = 5 * kUs;  // of every 500th tick
  core::Nanoseconds usual_work_ns = 20 * kUs;
  core::Nanoseconds rare_work_ns = 20 * kUs;
  core::Nanoseconds one_hang_ns = 0;
  int ticks = 5000;
};

const RealtimeBudget kBudget{.jitter_p999_max_ratio = 0.05, .source = "a file"};

TickSummary ran_on(const Host& host, const char* side, core::Nanoseconds period_ns) {
  ScriptedClock clock;
  const TickPolicy policy{.period_ns = period_ns, .max_behind = 10};
  const auto loop = std::make_unique<TickLoop>(clock, policy);
  loop->start();
  for (int i = 0; i < host.ticks; ++i) {
    const bool rare = i % 500 == 499;
    clock.next_wake_late_ns = i == 1234 ? host.one_hang_ns + host.usual_late_ns
                              : rare    ? host.rare_late_ns
                                        : host.usual_late_ns;
    loop->wait();
    clock.time_ns += rare ? host.rare_work_ns : host.usual_work_ns;
  }
  loop->end_tick();
  return summarise(side, "injected", policy, loop->record());
}

Verdict verdict_of(const Host& emulator, const Host& controller, std::string* reason = nullptr) {
  const auto checks = realtime_checks(ran_on(emulator, "emulator", 100 * kUs),
                                      ran_on(controller, "controller", kTickMs), kTickMs, kBudget);
  for (const auto& check : checks) {
    if (reason != nullptr && check.verdict != Verdict::kPass) {
      *reason += check.name + ": " + check.reason + "\n";
    }
  }
  return worst_of(checks);
}

TEST(RealtimeChecks, AnEvenHostPasses) {
  EXPECT_EQ(verdict_of({}, {}), Verdict::kPass);
}

TEST(RealtimeChecks, ALateHostProvesNothingAndTheWorstTickIsNamed) {
  std::string reason;
  EXPECT_EQ(verdict_of({.one_hang_ns = 2 * kTickMs}, {}, &reason), Verdict::kInvalid);
  EXPECT_EQ(reason,
            "emulator_host_on_time: the host was late: tick 1234 began 20 ticks of 100 us after it "
            "was due\n");
}

TEST(RealtimeChecks, UnevenWakeUpsOfTheControllerAreTheHostsFault) {
  EXPECT_EQ(verdict_of({}, {.rare_late_ns = 80 * kUs}), Verdict::kInvalid);
  EXPECT_EQ(verdict_of({}, {.rare_late_ns = 40 * kUs}), Verdict::kPass);
}

TEST(RealtimeChecks, UnevenWorkOfTheControllerFailsTheBudget) {
  std::string reason;
  EXPECT_EQ(verdict_of({}, {.rare_work_ns = 120 * kUs}, &reason), Verdict::kFail);
  EXPECT_EQ(reason.substr(0, 14), "control_jitter");
  EXPECT_EQ(verdict_of({}, {.rare_work_ns = 60 * kUs}), Verdict::kPass);
}

TEST(RealtimeChecks, UnevenWorkOnAHostThatWakesUnevenlyIsNotTheControllersFault) {
  EXPECT_EQ(verdict_of({}, {.rare_late_ns = 80 * kUs, .rare_work_ns = 120 * kUs}),
            Verdict::kInvalid);
}

// The host that withholds a processor from the emulator withholds it from the controller too.
TEST(RealtimeChecks, UnevenWorkBesideAnEmulatorThatIsWokenUnevenlyIsNotTheControllersFault) {
  const Host uneven_work{.rare_work_ns = 120 * kUs};
  EXPECT_EQ(verdict_of({.rare_late_ns = 60 * kUs}, uneven_work), Verdict::kInvalid);
  EXPECT_EQ(verdict_of({.rare_late_ns = 50 * kUs}, uneven_work), Verdict::kFail);
  EXPECT_EQ(verdict_of({.rare_late_ns = 60 * kUs}, {}), Verdict::kPass);
}

// Of every 500th tick p99 sees nothing.
TEST(RealtimeChecks, JitterIsThatOfTheTickInAThousand) {
  const auto figures = ran_on({.rare_work_ns = 120 * kUs}, "controller", kTickMs).execution;
  EXPECT_LT(figures.p99_ns, 25 * kUs);
  EXPECT_NEAR(jitter_ratio(figures, kTickMs), 0.1, 0.003);
}

TEST(RealtimeChecks, TheLimitIsTheBudgets) {
  const auto emulator = ran_on({}, "emulator", 100 * kUs);
  const auto controller = ran_on({.rare_work_ns = 120 * kUs}, "controller", kTickMs);
  const auto verdict = [&](double ratio) {
    const RealtimeBudget budget{.jitter_p999_max_ratio = ratio, .source = "a file"};
    return worst_of(realtime_checks(emulator, controller, kTickMs, budget));
  };
  EXPECT_EQ(verdict(0.11), Verdict::kPass);
  EXPECT_EQ(verdict(0.09), Verdict::kFail);
}

TEST(RealtimeChecks, TooFewTicksHaveNoJitter) {
  EXPECT_EQ(verdict_of({}, {.ticks = 999}), Verdict::kInvalid);
  EXPECT_EQ(verdict_of({}, {.ticks = 1000}), Verdict::kPass);
}

TEST(RealtimeBudget, IsThatOfTheShippedFile) {
  SourceFiles sources;
  const auto budget = load_realtime_budget(sources);
  EXPECT_EQ(budget.jitter_p999_max_ratio, 0.05);
  EXPECT_EQ(budget.source.substr(0, 10), "OR-BBMC-3c");
  EXPECT_EQ(sources.size(), 1U);
}

TEST(RealtimeBudget, WithoutItsLimitIsRefused) {
  const auto told = [](const char* text) -> std::string {
    try {
      (void)read_realtime_budget(FixtureFile::parse(text, "budget.toml"));
    } catch (const FixtureError& error) {
      return error.what();
    }
    return "accepted";
  };
  EXPECT_NE(told("schema = 1").find("jitter"), std::string::npos);
  EXPECT_NE(told("schema = 1\n[jitter]\nsource = \"a\"").find("p999_max_ratio"), std::string::npos);
  EXPECT_NE(told("schema = 1\n[jitter]\nsource = \"a\"\np999_max_ratio = 0.0").find("0 < x <= 1"),
            std::string::npos);
}

TEST(RealtimeChecks, ASideWithoutTicksIsNoEvidence) {
  TickSummary nothing;
  nothing.side = "emulator";
  EXPECT_EQ(worst_of(realtime_checks(nothing, ran_on({}, "controller", kTickMs), kTickMs, kBudget)),
            Verdict::kInvalid);
  EXPECT_EQ(worst_of(realtime_checks(ran_on({}, "emulator", kTickMs), nothing, kTickMs, kBudget)),
            Verdict::kInvalid);
}

TEST(TickSummary, SurvivesItsFile) {
  const auto summary = ran_on({.one_hang_ns = 2 * kTickMs}, "emulator", 100 * kUs);
  const auto again = tick_summary_from(to_json(summary));
  EXPECT_EQ(to_json(again), to_json(summary));
  EXPECT_EQ(text_of(again), text_of(summary));
}

}  // namespace
}  // namespace towbench::harness
