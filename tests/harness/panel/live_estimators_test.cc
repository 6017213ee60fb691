#include "harness/panel/live_estimators.h"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <memory>
#include <vector>

#include <gtest/gtest.h>

#include "harness/panel/live_tap.h"
#include "harness/run/experiment_run.h"

namespace towbench::harness {
namespace {

using Method = bbmc::VelocityMethod;

class LiveEstimatorsTest : public ::testing::TestWithParam<Method> {
 protected:
  ~LiveEstimatorsTest() override { std::filesystem::remove_all(out_); }
  std::filesystem::path out_ = [] {
    auto pattern = (std::filesystem::temp_directory_path() / "towbench-estimators-XXXXXX").string();
    return std::filesystem::path(mkdtemp(pattern.data()));
  }();
};

// What the lookers-on reckon from their own registers must be what the controller went by.
TEST_P(LiveEstimatorsTest, TheFollowedOneIsTheControllersOwnInEveryRow) {
  auto fixture = load_experiment("fixtures/experiments/trapezoid-400.toml");
  for (auto& axis : fixture.controller.configuration.axes) {
    axis.velocity.method = GetParam();
  }
  const auto tap = std::make_unique<LiveTap>();
  tap->clear(core::kNanosecondsPerMillisecond, LiveTap::Histogram::kTook, false);
  RunOptions options;
  options.out = out_;
  options.tap = tap.get();
  (void)run_experiment(fixture, options);
  LiveEstimators estimators{ShownMachine(fixture.controller.configuration)};
  std::size_t rows = 0;
  double fastest = 0;
  double apart = 0;
  std::vector<LiveRow> lives;
  ASSERT_EQ(tap->rows().copy(0, lives), 0U);
  for (const auto& live : lives) {
    ++rows;
    const auto speeds = estimators.update(live);
    for (const auto axis : core::kPlanarAxes) {
      ASSERT_DOUBLE_EQ(speeds[axis][static_cast<std::size_t>(GetParam())],
                       live.velocity_m_per_s[axis])
          << core::name_of(axis) << " at " << core::seconds(live.time_ns);
      fastest = std::max(fastest, std::fabs(live.velocity_m_per_s[axis]));
      apart = std::max(apart, std::fabs(speeds[axis][0] - speeds[axis][1]));
    }
  }
  EXPECT_EQ(tap->dropped(), 0U);
  EXPECT_GT(rows, 5000U);
  EXPECT_GT(fastest, 0.35);
  EXPECT_GT(apart, 1e-3) << "frequency and period have quanta of their own";
}
INSTANTIATE_TEST_SUITE_P(Methods, LiveEstimatorsTest,
                         ::testing::Values(Method::kFrequency, Method::kPeriod, Method::kHybrid));

TEST(LiveEstimators, ACountThatIsDeclaredAnewIsNoMotion) {
  const bbmc::Configuration configuration;
  LiveEstimators estimators{ShownMachine(configuration)};
  LiveRow live;
  for (int tick = 0; tick < 10; ++tick) {
    live.time_ns = tick * core::kNanosecondsPerMillisecond;
    live.count[core::Axis::kY] = tick < 5 ? 0 : 1'000'000;
    EXPECT_EQ(estimators.update(live)[core::Axis::kY][0], 0) << tick;
  }
}

}  // namespace
}  // namespace towbench::harness
