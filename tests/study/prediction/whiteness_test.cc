// What lasts is predicted by its own past, and noise is not; what repeats is found by its line.
#include "study/prediction/whiteness.h"

#include <cmath>
#include <numbers>

#include <gtest/gtest.h>

#include "core/random.h"
#include "study/prediction/lines.h"
#include "tests/study/prediction/simulated_run.h"

namespace towbench::tests {
namespace {

using namespace study::diagnose;
using Eigen::Index;
using Eigen::VectorXd;

constexpr double kCorrection = 50;  // rad/s: lags of ten samples

struct Recorded {
  std::vector<study::diagnose::Run> runs{simulated_run(parameters_of(simple_model()), 30, 0)};
  NominalModel stated = simple_model();
  Data data = make_data(runs, stated);
};

double predicted_share(double memory) {
  const Recorded recorded;
  core::Random random(1);
  VectorXd e(recorded.data.samples());
  double state = 0;
  for (double& value : e) {
    state = memory * state + random.gaussian();
    value = state;
  }
  return predicted_by_past(recorded.data, e, cut(recorded.data, kCorrection), kCorrection);
}

TEST(Whiteness, AnAutoregressionIsPredictedAsItsClosedFormSays) {
  const double kept = std::pow(0.97, 10);
  EXPECT_NEAR(predicted_share(0.97), 1 - std::sqrt(1 - kept * kept), 0.05);
}

TEST(Whiteness, NoiseIsNotPredicted) {
  EXPECT_LT(predicted_share(0), 0.002);
}

// Between two of the frequencies that are looked at, too.
TEST(Lines, AreFoundWhereverTheyLie) {
  const Recorded recorded;
  Context context = make_context(recorded.stated, recorded.data);
  for (double hertz = 3.27; hertz < 3.30; hertz += 0.004) {
    VectorXd e(recorded.data.samples());
    for (Index i = 0; i < e.size(); ++i) {
      e[i] = std::sin(2 * std::numbers::pi * hertz * 1e-3 * static_cast<double>(i));
    }
    find_lines(recorded.data, e, context);
    ASSERT_FALSE(context.lines_Hz.empty());
    EXPECT_NEAR(context.lines_Hz[0], hertz, 0.3 / 30) << hertz;
  }
}

TEST(Lines, AlongTheWayAreFoundByTheirPlace) {
  const Recorded recorded;
  Context context = make_context(recorded.stated, recorded.data);
  const double per_m = 12.3 / context.stroke_m;
  const VectorXd e = (2 * std::numbers::pi * per_m * recorded.runs[0].position_m.array()).sin();
  find_lines(recorded.data, e, context);
  ASSERT_FALSE(context.lines_per_m.empty());
  EXPECT_NEAR(context.lines_per_m[0], per_m, 0.3 / context.stroke_m);
}

}  // namespace
}  // namespace towbench::tests
