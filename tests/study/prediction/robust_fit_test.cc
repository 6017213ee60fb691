// Fits that what is missing in the model leads no farther astray than it must.
#include <cmath>
#include <numbers>
#include <random>

#include <gtest/gtest.h>

#include "study/prediction/search.h"
#include "tests/study/prediction/simulated_run.h"

namespace towbench::tests {
namespace {

using namespace study::diagnose;
using Eigen::Index;
using Eigen::VectorXd;
using Recording = study::diagnose::Run;

constexpr double kWholeTurn = 2 * std::numbers::pi;

// Somebody leans on the axis from 8 to 10 s, and nobody logs it.
Recording pushed_run(double push_N) {
  Recording run = simulated_run(parameters_of(simple_model()), 20, 2e-6);
  const VectorXd input = run.input_N;
  const NominalModel stated = simple_model();
  for (Index k = 8000; k < 10'000; ++k) run.input_N[k] += push_N;
  const Scene scene(run, stated);
  Axis axis(parameters_of(stated), scene);
  axis.place(1e-6, 0);
  for (Index k = 0; k < run.size(); ++k) {
    run.position_m[k] = (std::floor(axis.reading_m() / 2e-6) + 0.5) * 2e-6;
    axis.step(k);
  }
  run.input_N = input;
  return run;
}

double fitted_mass(const Data& data, const Context& context, bool weighted) {
  constexpr double kSlow = 30;
  const Model start{parameters_of(context.stated), std::vector<OfRun>(1)};
  std::vector<Span> spans = cut(data, kSlow);
  if (weighted) weigh(data, spans, innovations(data, start, kSlow));
  return fit_model(data, context, start, base_free_parameters(context, 1), kSlow, spans, 10)
      .model.parameters[Key::kMass];
}

TEST(Weigh, APushThatNobodyLoggedLeadsNoFitAstray) {
  const std::vector<Recording> runs{pushed_run(15)};
  const NominalModel stated = simple_model();
  const Data data = make_data(runs, stated);
  const Context context = make_context(stated, data);
  EXPECT_NEAR(fitted_mass(data, context, true), 8, 0.05);
  EXPECT_GT(std::abs(fitted_mass(data, context, false) - 8), 0.15) << "without weights";
}

TEST(Weigh, BlocksThatStandAreNoMeasureOfThoseThatMove) {
  Recording run = simulated_run(parameters_of(simple_model()), 20, 2e-6);
  for (Index k = 0; k < 14'000; ++k) run.position_m[k] = run.position_m[0];
  const std::vector<Recording> runs{run};
  const NominalModel stated = simple_model();
  const Data data = make_data(runs, stated);
  std::vector<Span> spans = cut(data, 30);
  VectorXd e = VectorXd::Constant(run.size(), 1e-8);
  e.tail(6000).setConstant(1e-6);
  weigh(data, spans, e);
  for (const Span& span : spans) EXPECT_EQ(span.weight, 1);
}

// A fit that ends at once with it in the runs: no data tell whether it is theirs or the model's.
TEST(FitModel, WhatAllRunsHaveAlikeIsTheModels) {
  Parameters truth = parameters_of(simple_model());
  truth[Key::kBias] = 0.5;
  truth[Key::kCoulomb] = 2.4;
  const std::vector<Recording> runs{simulated_run(truth, 5, 2e-6), simulated_run(truth, 3, 2e-6)};
  const NominalModel stated = simple_model();
  const Data data = make_data(runs, stated);
  const Context context = make_context(stated, data);
  Model start{parameters_of(stated), std::vector<OfRun>(2)};
  for (OfRun& run : start.of_run) {
    run.bias_N = 0.5;
    run.coulomb_N = 0.4;
  }
  start.of_run[0].bias_N += 0.1;
  const Model fitted =
      fit_model(data, context, start, base_free_parameters(context, 2), 30, cut(data, 30), 0).model;
  EXPECT_NEAR(fitted.parameters[Key::kBias], 0.55, 1e-12);
  EXPECT_NEAR(fitted.parameters[Key::kCoulomb], 2.4, 1e-12);
  EXPECT_NEAR(fitted.of_run[0].bias_N, 0.05, 1e-12);
  EXPECT_NEAR(fitted.of_run[1].coulomb_N, 0, 1e-12);
}

TEST(FitModel, WhatRunsLackOfDryFrictionMakesTheModelsNoneNegative) {
  const std::vector<Recording> runs{simulated_run(parameters_of(simple_model()), 5, 2e-6),
                                    simulated_run(parameters_of(simple_model()), 5, 2e-6)};
  const NominalModel stated = simple_model();
  const Data data = make_data(runs, stated);
  const Context context = make_context(stated, data);
  Model start{parameters_of(stated), std::vector<OfRun>(2)};
  start.parameters[Key::kCoulomb] = 0.5;
  for (OfRun& run : start.of_run) run.coulomb_N = -1;
  const Model fitted =
      fit_model(data, context, start, base_free_parameters(context, 2), 30, cut(data, 30), 0).model;
  EXPECT_GE(fitted.parameters[Key::kCoulomb], 0);
}

// An encoder so coarse that a fast correction follows its steps.
TEST(Bandwidth, IsNoFasterThanAnEncodersStepsAllow) {
  constexpr double kStep_m = 1e-3;
  Parameters truth = parameters_of(simple_model());
  truth[Key::kCoulomb] *= 1.1;
  const std::vector<Recording> runs{simulated_run(truth, 20, kStep_m)};
  const NominalModel stated = simple_model();
  const Data data = make_data(runs, stated);
  const Context context = make_context(stated, data);
  const Model model{parameters_of(stated), std::vector<OfRun>(1)};
  const double slow = best_bandwidth(data, context, model, kFollowed);
  const double fast = best_bandwidth(data, context, model, 0);
  EXPECT_LT(slow, 0.5 * fast);
  const VectorXd e = innovations(data, model, slow);
  EXPECT_LT(e.norm() / std::sqrt(static_cast<double>(e.size())), kFollowed * kStep_m);
}

// White noise as the input says nothing of the mass: it stays where it is believed.
TEST(FitModel, KeepsAMassThatIsBelieved) {
  Recording run = simulated_run(parameters_of(simple_model()), 10, 2e-6);
  std::mt19937_64 random(3);
  std::normal_distribution<double> white(0, 10);
  for (double& force : run.input_N) force = white(random);
  const std::vector<Recording> runs{run};
  const NominalModel stated = simple_model();
  const Data data = make_data(runs, stated);
  const Context context = make_context(stated, data);
  const double mass = fitted_mass(data, context, false);
  EXPECT_LE(mass, context.mass_most_kg);
  EXPECT_GT(mass, 2 * stated.mass_kg) << "what nothing moves is heavy";
}

// The same force in time in two runs, begun at a phase of its own.
TEST(Screening, FindsAForceInTimeWhosePhaseEachRunHasForItself) {
  constexpr double kHertz = 3.7;
  const NominalModel stated = simple_model();
  std::vector<Recording> runs;
  for (const double turns : {0.0, 0.5}) {
    Parameters truth = parameters_of(stated);
    truth[Key::kPeriodicHertz] = kHertz;
    truth[Key::kPeriodicCosine] = 0.8 * std::cos(kWholeTurn * turns);
    truth[Key::kPeriodicSine] = 0.8 * std::sin(kWholeTurn * turns);
    runs.push_back(simulated_run(truth, 15, 2e-6));
  }
  const Data data = make_data(runs, stated);
  const Search found = search_causes(data, make_context(stated, data),
                                     {parameters_of(stated), std::vector<OfRun>(runs.size())}, {});
  ASSERT_EQ(found.causes.size(), 1U);
  EXPECT_EQ(found.causes[0].effect->name, "periodic_force");
  const Parameters& p = found.final.fitted.model.parameters;
  EXPECT_NEAR(p[Key::kPeriodicHertz], kHertz, 0.01);
  EXPECT_NEAR(std::hypot(p[Key::kPeriodicCosine], p[Key::kPeriodicSine]), 0.8, 0.05);
}

}  // namespace
}  // namespace towbench::tests
