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
  core::Nanoseconds rare_late_ns = 5 * kUs;  // of every 50th tick
  core::Nanoseconds usual_work_ns = 20 * kUs;
  core::Nanoseconds rare_work_ns = 20 * kUs;
  core::Nanoseconds one_hang_ns = 0;
};

TickSummary ran_on(const Host& host, const char* side, core::Nanoseconds period_ns) {
  ScriptedClock clock;
  const TickPolicy policy{.period_ns = period_ns, .max_behind = 10};
  const auto loop = std::make_unique<TickLoop>(clock, policy);
  loop->start();
  constexpr int kTicks = 5000;
  for (int i = 0; i < kTicks; ++i) {
    const bool rare = i % 50 == 49;
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
                                      ran_on(controller, "controller", kTickMs), kTickMs);
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

TEST(RealtimeChecks, ASideWithoutTicksIsNoEvidence) {
  TickSummary nothing;
  nothing.side = "emulator";
  EXPECT_EQ(worst_of(realtime_checks(nothing, ran_on({}, "controller", kTickMs), kTickMs)),
            Verdict::kInvalid);
  EXPECT_EQ(worst_of(realtime_checks(ran_on({}, "emulator", kTickMs), nothing, kTickMs)),
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
