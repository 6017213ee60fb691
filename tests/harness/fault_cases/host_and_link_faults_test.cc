// What ends a link and what happens to a host: found in time, whatever the control rate.
#include <cmath>

#include <gtest/gtest.h>

#include "tests/harness/fault_cases/stage.h"

namespace towbench::harness {
namespace {

constexpr const char* kMotion = "trapezoid-400";
constexpr const char* kSlowRate = "../motions/open-loop-y-10hz";

std::unique_ptr<CaseRecord> run_of(const std::string& experiment, const std::string& words) {
  std::unique_ptr<CaseRecord> run;
  const auto verdict = stage(experiment).carry_out(words, &run);
  EXPECT_EQ(verdict.verdict(), Verdict::kPass) << words << '\n' << words_of(verdict);
  return run;
}

// 50 ms are less than one control period at 10 Hz.
TEST(StoppedHost, IsNoticedAtTheFirstExchangeAfterwardsWhateverTheControlRate) {
  struct Rate {
    const char* experiment;
    double from_s;
  };
  for (const auto& [experiment, from_s] : {Rate{kMotion, 2.0}, Rate{kSlowRate, 0.4}}) {
    const auto run =
        run_of(experiment, fmt::format("host stopped_process at={}s length=50ms", from_s));
    const auto* fault = run->first_fault();
    ASSERT_NE(fault, nullptr) << experiment;
    EXPECT_EQ(fault->code, core::ErrorCode::kFaultControlOverrun) << experiment;
    EXPECT_LE(core::seconds(fault->time_ns), from_s + 0.050 + 1.1e-3) << experiment;
  }
}

TEST(StoppedHost, ShorterThanTwentyMillisecondsIsBorne) {
  EXPECT_EQ(run_of(kMotion, "host late_tick at=2s delay=19ms")->first_fault(), nullptr);
}

// A clock that goes back would keep the next control tick waiting with the last duty on.
TEST(ClockStep, BackTakesTheDriveAwayAtOnce) {
  for (const char* experiment : {kMotion, kSlowRate}) {
    const auto run = run_of(experiment, "host clock_step at=0.5s step=-20ms");
    const auto* fault = run->first_fault();
    ASSERT_NE(fault, nullptr) << experiment;
    EXPECT_EQ(fault->code, core::ErrorCode::kFaultControlOverrun);
    EXPECT_LE(core::seconds(fault->time_ns), 0.5 + 1.1e-3);
    EXPECT_FALSE(run->driven_at(core::nanoseconds(0.502)));
  }
}

TEST(ClockStep, AheadLooksLikeMeasurementsThatAreTooOld) {
  const auto run = run_of(kMotion, "host clock_step at=2s step=0.1s");
  const auto* fault = run->first_fault();
  ASSERT_NE(fault, nullptr);
  EXPECT_EQ(fault->code, core::ErrorCode::kFaultLinkLost);
  EXPECT_LE(core::seconds(fault->time_ns), 2.0 + 1.1e-3);
}

TEST(EndOfALink, LatchesLinkLostAndRemovesTheDrive) {
  for (const char* words :
       {"link.to_controller bus_off at=2s", "link.to_controller peer_killed at=2s",
        "link.to_controller peer_restart at=2s",
        "link.to_controller baud_mismatch at=2s ratio=0.125",
        "link.to_plant baud_mismatch at=2s ratio=8"}) {
    const auto run = run_of(kMotion, words);
    const auto* fault = run->first_fault();
    ASSERT_NE(fault, nullptr) << words;
    EXPECT_TRUE(fault->code == core::ErrorCode::kFaultLinkLost ||
                fault->code == core::ErrorCode::kFaultLinkCorrupt)
        << words;
    EXPECT_LE(core::seconds(fault->time_ns), 2.0 + 1.1e-3) << words;
    EXPECT_FALSE(run->driven_at(run->outcome.end_ns + run->outcome.exchange_ns)) << words;
  }
}

TEST(BaudMismatch, WithinWhatAUartBearsHasNoEffect) {
  EXPECT_FALSE(stage(kMotion).carry_out("link.to_controller baud_mismatch at=2s ratio=0.97").fired);
}

// What a bus does to the data is done without a bus too: the same motion, not the same bits.
TEST(CanFrames, CarryAFaultFreeRunThatDiffersFromTheEdgesOnlyInWhatIsMeasured) {
  auto& mid = stage(kMotion);
  const auto framed = run_reference(mid.plain, 1, true);
  ASSERT_EQ(framed->log.size(), mid.reference->log.size());
  EXPECT_EQ(framed->first_fault(), nullptr);
  EXPECT_GE(first_difference_ns(*framed, *mid.reference), 0);
  double farthest_m = 0;
  for (std::size_t i = 0; i < framed->truth.size(); ++i) {
    farthest_m =
        std::max(farthest_m, std::fabs(framed->truth[i].axes[core::Axis::kY].carriage_m -
                                       mid.reference->truth[i].axes[core::Axis::kY].carriage_m));
  }
  EXPECT_LT(farthest_m, 2e-3);
}

}  // namespace
}  // namespace towbench::harness
