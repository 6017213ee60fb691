// The thesis's own controllers on a shipped experiment: their steady errors are those of a loop
// whose integral takes seconds, not those of the bench's gains.
#include <gtest/gtest.h>

#include "tests/harness/end_to_end/run_support.h"

namespace towbench::harness {
namespace {

struct SteadyError {
  const char* controller;
  double least_m;  // of the mean error at 400 mm/s
  double most_m;
};

class OwnGains : public ::testing::TestWithParam<SteadyError> {};

// Without the integral the error is friction over K_P: C + B w of Table 7.4 at 280 rad/s, up to
// 1.6e-3 N m more in mid tank, is 9.1 to 11.8 mm by Table 7.2 and 1.5 to 2.0 mm by BBMC 0.5. With
// K_I/K_P = 0.25/s a share of that is left over the window, 1.3 s to 5.4 s after the ramp.
TEST_P(OwnGains, LeaveTheErrorThatFrictionMakesOfThem) {
  const auto& expected = GetParam();
  auto fixture = Runs::shipped("trapezoid-400");
  SourceFiles sources;
  fixture.controller = load_controller(
      "fixtures/controllers/" + std::string(expected.controller) + ".toml", sources);
  Runs runs;
  const auto run = runs.run(fixture);
  const auto* error = check_named(run, "y_tracking_error_mean_m");
  ASSERT_NE(error, nullptr) << complaints_of(run);
  ASSERT_TRUE(error->value.has_value());
  EXPECT_GT(*error->value, expected.least_m);
  EXPECT_LT(*error->value, expected.most_m);
  ASSERT_NE(check_named(run, "fault_number"), nullptr);
  EXPECT_EQ(check_named(run, "fault_number")->verdict, Verdict::kPass) << complaints_of(run);
}

INSTANTIATE_TEST_SUITE_P(Controllers, OwnGains,
                         ::testing::Values(SteadyError{"bbmc-table-7.2", 3e-3, 7e-3},
                                           SteadyError{"bbmc-0.5", 0.6e-3, 1.4e-3}),
                         [](const auto& each) {
                           return std::string(each.index == 0 ? "Table72" : "Bbmc05");
                         });

}  // namespace
}  // namespace towbench::harness
