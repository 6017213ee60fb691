// When runs began in their session: by the clock of their logs, where one has timed them all.
#include "study/prediction/session_clock.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/study/prediction/simulated_run.h"

namespace towbench::tests {
namespace {

using namespace study::diagnose;
using ::testing::DoubleEq;
using ::testing::ElementsAre;
using ::testing::IsEmpty;

constexpr double kLength_s = 2;

study::diagnose::Run started_at(double start_s) {
  study::diagnose::Run run = simulated_run(parameters_of(simple_model()), kLength_s, 0, 0.01);
  run.start_s = start_s;
  return run;
}

std::vector<double> starts_of(const std::vector<study::diagnose::Run>& runs) {
  std::vector<const study::diagnose::Run*> all;
  for (const auto& run : runs) all.push_back(&run);
  return starts_on_one_clock(all);
}

std::vector<double> session_starts_of(const Data& data) {
  std::vector<double> starts_s;
  for (const Scene& scene : data.scenes) starts_s.push_back(scene.session_start_s);
  return starts_s;
}

TEST(SessionClock, CountsFromTheEarliestRun) {
  EXPECT_THAT(starts_of({started_at(1000), started_at(1065), started_at(1010)}),
              ElementsAre(0, 65, 10));
}

TEST(SessionClock, IsNotOneWhereRunsOverlap) {
  EXPECT_THAT(starts_of({started_at(0), started_at(0)}), IsEmpty());
  EXPECT_THAT(starts_of({started_at(5), started_at(5 + 0.9 * kLength_s)}), IsEmpty());
}

TEST(SessionClock, IsNotOneAcrossMoreThanAnHour) {
  EXPECT_THAT(starts_of({started_at(0), started_at(3000)}), ElementsAre(0, 3000));
  EXPECT_THAT(starts_of({started_at(0), started_at(4000)}), IsEmpty());
}

TEST(SessionClock, TimesTheRunsThatAreFitted) {
  const NominalModel stated = simple_model();
  const std::vector timed{started_at(7), started_at(47)};
  const Data data = make_data(timed, stated);
  EXPECT_THAT(session_starts_of(data), ElementsAre(0, 40));
  EXPECT_DOUBLE_EQ(data.scenes.front().session_length_s, 40 + kLength_s);
  const std::vector untimed{started_at(0), started_at(0)};
  EXPECT_THAT(session_starts_of(make_data(untimed, stated)), ElementsAre(0, DoubleEq(kLength_s)));
}

TEST(SessionClock, TimesOtherRunsInTheSessionOfThoseThatAreFitted) {
  const NominalModel stated = simple_model();
  const std::vector fitted{started_at(100), started_at(160)};
  const std::vector others{started_at(130), started_at(90), started_at(0), started_at(101)};
  const Data data = make_data(fitted, stated);
  const Data like = make_data_like(data, others, stated);
  EXPECT_THAT(session_starts_of(like), ElementsAre(30, -10, -100, 0))
      << "between, before, long before, and at the same time as one of them: another session";
}

}  // namespace
}  // namespace towbench::tests
