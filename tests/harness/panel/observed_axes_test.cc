// What the panel is told of another controller's machine: its speed from its encoders, and every
// axis that it has.
#include <cmath>
#include <thread>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "harness/panel/frames.h"
#include "harness/panel/live_estimators.h"
#include "harness/panel/session.h"
#include "harness/record/temporary_folder.h"

namespace towbench::harness {
namespace {

using core::Axis;
using nlohmann::json;

constexpr const char* kObservedPid =
    "python3 clients/python/examples/pid.py {address} yxc c.metres_per_count=4.4908e-5 "
    "c.inertia=0.0071";

class ObservedAxes : public ::testing::Test {
 protected:
  ~ObservedAxes() override { session_.cut_short(); }

  void run(const std::string& experiment) {
    session_.start({.experiment = experiment, .pace = {.speed = 0, .paused = false}});
    while (session_.state().phase != Session::Phase::kOver) {
      std::this_thread::yield();
    }
    ASSERT_EQ(session_.state().verdict, "PASS") << session_.state().reason;
  }

  TemporaryFolder out_;
  Session session_{out_.path(), ExternalController{.command = kObservedPid}};
};

TEST_F(ObservedAxes, MoveAtTheSpeedThatTheirEncodersShow) {
  run("fixtures/any-controller/turned-body.toml");
  LiveEstimators estimators(shown_configuration(*session_.fixture()));
  std::vector<LiveRow> rows;
  ASSERT_EQ(session_.tap().rows().copy(0, rows), 0U);
  constexpr std::size_t kHybrid = 2;
  std::size_t compared = 0;
  double fastest_rad_per_s = 0;
  for (const auto& row : rows) {
    const auto speeds = estimators.update(row);
    fastest_rad_per_s = std::max(fastest_rad_per_s, speeds[Axis::kC][kHybrid]);
    if (row.time_ns > 3 * core::kNanosecondsPerSecond &&
        row.time_ns < 5 * core::kNanosecondsPerSecond) {
      ASSERT_NEAR(speeds[Axis::kY][kHybrid], 0.3, 0.03) << core::seconds(row.time_ns);
      ++compared;
    }
  }
  EXPECT_GT(compared, 1'900U);
  EXPECT_NEAR(fastest_rad_per_s, 1.5, 0.15);
}

TEST_F(ObservedAxes, AreAllInARow) {
  run("fixtures/any-controller/turned-body.toml");
  FrameMaker frames(session_);
  const auto told = json::parse(frames.next());
  const auto& limits = told.at("state").at("limits");
  EXPECT_EQ(limits.size(), 3U);
  EXPECT_TRUE(limits.at("c").at("turns").get<bool>());
  EXPECT_EQ(limits.at("c").at("hard_max_m"), 3.3);
  // reports/src/panel/wire.ts: 22 and 10 of y and x, then 9 and 4 of each of z to c.
  const auto& row = told.at("rows").back();
  const auto& truth = told.at("truth").back();
  ASSERT_EQ(row.size(), 22U + 4U * 9U);
  ASSERT_EQ(truth.size(), 10U + 4U * 4U);
  constexpr std::size_t kC = 3;  // of z, a, b, c
  EXPECT_NEAR(row.at(22 + 9 * kC).get<double>(), std::acos(0.0), 1e-3) << "reference";
  EXPECT_NEAR(row.at(23 + 9 * kC).get<double>(), std::acos(0.0), 1e-3) << "position";
  EXPECT_NEAR(truth.at(10 + 4 * kC).get<double>(), std::acos(0.0), 1e-3);
  EXPECT_EQ(truth.at(10).get<double>(), 0.0) << "there is no axis z";
}

}  // namespace
}  // namespace towbench::harness
