// A law whose fit has many minima is found from far away.
#include <cmath>
#include <numbers>

#include <gtest/gtest.h>

#include "study/prediction/search.h"
#include "tests/study/prediction/simulated_run.h"

namespace towbench::tests {
namespace {

using namespace study::diagnose;

// A load that is four fifths of the mass, on flanks of 100 Hz: the rigid model's fit is far from
// its own mass, and a play that is off by its half predicts no better than none.
TEST(RoughLaw, PlayIsFoundWithItsSize) {
  constexpr double kPlay_m = 3e-3;
  const NominalModel stated = simple_model();
  Parameters truth = parameters_of(stated);
  truth[Key::kMotorMass] = 0.2 * truth[Key::kMass];
  const double reduced_kg = 0.8 * truth[Key::kMotorMass];
  const double pulsation = 2 * std::numbers::pi * 100;
  truth[Key::kStiffness] = reduced_kg * pulsation * pulsation;
  truth[Key::kDamping] = 0.4 * reduced_kg * pulsation;
  truth[Key::kPlay] = kPlay_m;
  truth[Key::kLoadShare] = 0.65;
  const std::vector<study::diagnose::Run> runs{simulated_run(truth, 20, 5e-6)};
  const Data data = make_data(runs, stated);
  const Search found = search_causes(data, make_context(stated, data),
                                     {parameters_of(stated), std::vector<OfRun>(1)}, Limits{});
  ASSERT_EQ(found.causes.size(), 1);
  EXPECT_EQ(found.causes.front().effect->name, "backlash");
  EXPECT_NEAR(found.final.fitted.model.parameters[Key::kPlay], kPlay_m, 0.05 * kPlay_m);
}

}  // namespace
}  // namespace towbench::tests
