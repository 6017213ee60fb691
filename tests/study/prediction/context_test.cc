// What is known of the data before anything is fitted.
#include "study/prediction/context.h"

#include <algorithm>

#include <gtest/gtest.h>

#include "study/prediction/fit.h"
#include "tests/study/prediction/simulated_run.h"

namespace towbench::tests {
namespace {

using namespace study::diagnose;
using Eigen::VectorXd;
using Recording = study::diagnose::Run;

// From 1 m, 0.5 m on; `back_m` of it back, in the middle.
Recording going(double direction, double back_m) {
  Recording run;
  run.period_s = 1e-3;
  run.resolution_m = 1e-6;
  VectorXd way(3000);
  way << VectorXd::LinSpaced(1000, 0, 0.25), VectorXd::LinSpaced(1000, 0.25, 0.25 - back_m),
      VectorXd::LinSpaced(1000, 0.25 - back_m, 0.5);
  run.position_m = 1 + direction * way.array();
  run.input_N = VectorXd::Zero(way.size());
  run.missing.assign(static_cast<std::size_t>(way.size()), 0);
  return run;
}

double one_way_of(const std::vector<Recording>& runs) {
  const NominalModel stated = simple_model();
  return one_way(make_data(runs, stated));
}

TEST(OneWay, IsTheDirectionOfAllRuns) {
  EXPECT_EQ(one_way_of({going(1, 0)}), 1);
  EXPECT_EQ(one_way_of({going(-1, 0), going(-1, 0.009)}), -1);
  EXPECT_EQ(one_way_of({going(1, 0), going(-1, 0)}), 0);
  EXPECT_EQ(one_way_of({going(1, 0), going(1, 0.011)}), 0);
}

TEST(OneWay, LeavesNoConstantForceToBeFitted) {
  const NominalModel stated = simple_model();
  const auto fits_a_constant_force = [&](const std::vector<Recording>& runs) {
    const auto free = base_free_parameters(make_context(stated, make_data(runs, stated)), 2);
    return std::any_of(free.begin(), free.end(), [](const FreeParameter& f) {
      return f.of == FreeParameter::Of::kAll && f.key == Key::kBias;
    });
  };
  EXPECT_FALSE(fits_a_constant_force({going(1, 0), going(1, 0)}));
  EXPECT_TRUE(fits_a_constant_force({going(1, 0), going(-1, 0)}));
}

}  // namespace
}  // namespace towbench::tests
