#include "harness/run/encoder_rate.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/harness/end_to_end/run_support.h"
#include "tests/protocol/edges_in_memory.h"

namespace towbench::harness {
namespace {

using ::testing::HasSubstr;

TEST(EncoderRate, ARehearsalFindsTheSpeedOfTheExperiment) {
  const auto peak = rehearse_edges(Runs::shipped("trapezoid-400"), 1);
  EXPECT_EQ(peak.exchange_ns, core::kNanosecondsPerMillisecond);
  // 0.4 m/s at 2.24 um a count (TRK-1: half a count is 1.12 um), and the transmission's swing.
  const double profile = 0.4 / 2.24e-6;
  EXPECT_GT(peak.edges_per_s(), profile);
  EXPECT_LT(peak.edges_per_s(), 1.25 * profile);
}

TEST(EncoderRate, IsRefusedAboveWhatTheLinesAreRatedForWithBothFigures) {
  const EdgePeak peak{.edges = 180, .exchange_ns = 1'000'000, .at_ns = 1'500'000'000};
  EXPECT_TRUE(accept_edges(peak, {}).has_value());
  EXPECT_TRUE(accept_edges(peak, {180'000, "as rated"}).has_value());
  const auto refused = accept_edges(peak, {20'000, "as rated"});
  ASSERT_FALSE(refused.has_value());
  EXPECT_EQ(refused.error().message,
            "180000 edges/s at its fastest (180 in the 1 ms up to 1.500 s); the lines carry 20000 "
            "edges/s (as rated)");
}

TEST(EncoderRate, IsRefusedAboveFourFifthsOfTheKernelsQueueWhateverTheLinesAreRatedFor) {
  EXPECT_TRUE(accept_edges({.edges = 819, .exchange_ns = 1'000'000}, {}).has_value());
  const auto refused = accept_edges({.edges = 820, .exchange_ns = 1'000'000}, {});
  ASSERT_FALSE(refused.has_value());
  EXPECT_THAT(refused.error().message, HasSubstr("the kernel keeps 1024 edges"));
}

TEST(EncoderRate, IsMeasuredOnTheLinesThemselves) {
  // Each edge takes 10 us, by a clock of this test's.
  core::Nanoseconds now_ns = 0;
  protocol::EdgesInMemory lines([&] { return now_ns; });
  struct Slow final : protocol::EdgeDriver {
    Slow(protocol::EdgeDriver& the_driver, core::Nanoseconds& the_time) noexcept
        : driver(the_driver), time_ns(the_time) {}
    core::Status set(unsigned place, bool level) noexcept override {
      time_ns += 10'000;
      return driver.set(place, level);
    }
    [[nodiscard]] bool has_index() const noexcept override { return driver.has_index(); }
    protocol::EdgeDriver& driver;
    core::Nanoseconds& time_ns;
  } driver(lines.driver(), now_ns);
  const auto rate = measure_edges_per_s(driver, lines.reader());
  ASSERT_TRUE(rate.has_value());
  EXPECT_DOUBLE_EQ(*rate, 100'000.0);
  EXPECT_EQ(*lines.reader().levels(), 0U);
}

TEST(EncoderRate, LinesOnWhichEdgesGetLostHaveNone) {
  core::Nanoseconds now_ns = 0;
  protocol::EdgesInMemory lines([&] { return now_ns += 1'000'000; });
  lines.coalesce_one();
  EXPECT_FALSE(measure_edges_per_s(lines.driver(), lines.reader()).has_value());
}

}  // namespace
}  // namespace towbench::harness
