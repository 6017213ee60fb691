// Innovations: nothing of a right model but the encoder, and what a wrong one lacks.
#include "study/prediction/predictor.h"

#include <gtest/gtest.h>

#include "study/prediction/fit.h"
#include "tests/study/prediction/simulated_run.h"

namespace towbench::tests {
namespace {

using namespace study::diagnose;
using Eigen::VectorXd;

constexpr double kBandwidth = 30;  // rad/s

VectorXd innovations_of_run(const Run& run, const Parameters& believed) {
  const std::vector<study::diagnose::Run> runs{run};
  const NominalModel stated = simple_model();
  return innovations(make_data(runs, stated), {believed, std::vector<OfRun>(1)}, kBandwidth);
}

double root_mean_square(const VectorXd& x) {
  return x.norm() / std::sqrt(static_cast<double>(x.size()));
}

TEST(Innovations, OfAnExactModelAreNothing) {
  const Parameters truth = parameters_of(simple_model());
  EXPECT_LT(innovations_of_run(simulated_run(truth, 10, 0), truth).cwiseAbs().maxCoeff(), 1e-12);
}

// Rounding alone leaves 0.29 steps.
TEST(Innovations, OfAnExactModelStayBelowHalfAnEncoderStep) {
  constexpr double kStep_m = 2e-6;
  const Parameters truth = parameters_of(simple_model());
  const VectorXd e = innovations_of_run(simulated_run(truth, 10, kStep_m), truth);
  EXPECT_LT(root_mean_square(e), 0.35 * kStep_m);
  EXPECT_GT(root_mean_square(e), 0.2 * kStep_m);
}

TEST(Innovations, ShowAMissingForceInNewtons) {
  constexpr double kForce_N = 0.7;
  NominalModel frictionless = simple_model();
  frictionless.coulomb_N = 0;
  Parameters truth = parameters_of(frictionless);
  const Parameters believed = truth;
  truth[Key::kBias] = kForce_N;  // the drive must make it besides
  const VectorXd e = innovations_of_run(simulated_run(truth, 3, 0, 1e-4), believed);
  // What the correction of the speed adds to the drag.
  const double drag = 2 * kBandwidth * truth[Key::kViscous];
  const double scale = truth[Key::kMass] * kBandwidth * kBandwidth + drag;
  EXPECT_NEAR(scale * e.tail(20'000).maxCoeff(), -kForce_N, 0.02 * kForce_N);
  EXPECT_NEAR(scale * e.tail(20'000).minCoeff(), -kForce_N, 0.02 * kForce_N);
}

TEST(Innovations, SayNothingBehindAGap) {
  const Parameters truth = parameters_of(simple_model());
  study::diagnose::Run run = simulated_run(truth, 3, 0);
  run.missing[1500] = 1;
  run.position_m[1500] += 1;
  const VectorXd e = innovations_of_run(run, truth);
  EXPECT_LT(e.cwiseAbs().maxCoeff(), 1e-12) << "what is missing corrects nothing";
}

// The log begins while motor and load swing against each other, which a prediction cannot know. Its
// correction moves both as the mode asks: the swing is found within half a second, where its own
// damping would leave a half of it.
TEST(Innovations, OfAnElasticAxisFindTheSwingThatTheLogBeginsWith) {
  Parameters truth;
  truth[Key::kMass] = 8;
  truth[Key::kMotorMass] = 2;
  truth[Key::kStiffness] = 8000;  // 11.6 Hz
  truth[Key::kDamping] = 4;
  study::diagnose::Run run = simulated_run(truth, 3, 0);
  constexpr Eigen::Index kCut = 250;
  run.position_m = run.position_m.tail(run.size() - kCut).eval();
  run.input_N = run.input_N.tail(run.input_N.size() - kCut).eval();
  run.missing.resize(static_cast<std::size_t>(run.size()));
  const VectorXd e = innovations_of_run(run, truth);
  const double early = e.segment(200, 100).cwiseAbs().maxCoeff();
  const double later = e.segment(600, 100).cwiseAbs().maxCoeff();
  EXPECT_GT(early, 1e-9);
  EXPECT_LT(later, 0.1 * early);
}

// The log begins while the axis stands on bristles that are bent by half of what they hold, which
// no prediction can know. It finds the bend: a correction moves the axis and not the bristles.
TEST(Innovations, OfAnAxisOnBristlesFindTheBendThatTheLogBeginsWith) {
  Parameters truth = parameters_of(simple_model());
  truth[Key::kPresliding] = 2 * truth[Key::kCoulomb];
  truth[Key::kPreslidingTravel] = 1e-3;
  truth[Key::kPreslidingTime] = 0.02;
  study::diagnose::Run run = simulated_run(truth, 3, 0);
  run.input_N.setConstant(0.5 * truth[Key::kCoulomb]);
  run.position_m.setConstant(0.3);
  run.position_m.tail(1).setConstant(0.4);  // a stroke
  const VectorXd e = innovations_of_run(run, truth);
  const double to_force = truth[Key::kMass] * kBandwidth * kBandwidth;
  EXPECT_GT(to_force * e.segment(200, 100).cwiseAbs().maxCoeff(), 0.05);
  EXPECT_LT(to_force * e.segment(2000, 500).cwiseAbs().maxCoeff(), 0.01);
}

// A prediction that stops and goes on is the same: a long recording is looked at piece by piece.
// Of x, M x'' + B x' + C sgn(x') = (1 - k) u; read as (1 - k) x with C / (1 - k) it is the same.
TEST(Innovations, OfLostCountsAreThoseOfAWrongGain) {
  constexpr double kLoss = 0.2;
  const study::diagnose::Run run = simulated_run(parameters_of(simple_model()), 5, 2e-6);
  Parameters gain = parameters_of(simple_model());
  Parameters counts = gain;
  gain[Key::kGainLoss] = counts[Key::kCountLoss] = kLoss;
  counts[Key::kCoulomb] /= 1 - kLoss;
  const VectorXd e = innovations_of_run(run, gain);
  EXPECT_LT((innovations_of_run(run, counts) - e).norm(), 1e-6 * e.norm());
  EXPECT_GT(root_mean_square(e), 1e-5);
}

TEST(Innovations, InPiecesAreThoseOfTheWhole) {
  const Parameters truth = parameters_of(simple_model());
  const std::vector<study::diagnose::Run> runs{simulated_run(truth, 3, 2e-6)};
  const NominalModel stated = simple_model();
  const Data data = make_data(runs, stated);
  const VectorXd whole = innovations_of(data, 0, truth, kBandwidth);
  VectorXd pieces(whole.size());
  Innovations next(data, 0, truth, kBandwidth);
  next.next(pieces.head(700));
  next.next(pieces.segment(700, 1));
  next.next(pieces.tail(pieces.size() - 701));
  EXPECT_EQ((whole - pieces).cwiseAbs().maxCoeff(), 0);
}

TEST(Variations, SpanBySpanHaveTheProductsOfTheirColumns) {
  const Parameters truth = parameters_of(simple_model());
  const std::vector<study::diagnose::Run> runs{simulated_run(truth, 4, 2e-6),
                                               simulated_run(truth, 3, 2e-6)};
  const NominalModel stated = simple_model();
  const Data data = make_data(runs, stated);
  Model model{truth, std::vector<OfRun>(2)};
  model.parameters[Key::kCoulomb] *= 1.2;
  const auto free = base_free_parameters(make_context(stated, data), 2);
  const VectorXd e = innovations(data, model, kBandwidth);
  const auto spans = cut(data, kBandwidth);
  const auto columns = columns_of(data, e, varied(model, free), kBandwidth);
  const auto grams = grams_of(data, e, varied(model, free), kBandwidth, spans);
  ASSERT_EQ(grams.size(), spans.size());
  for (std::size_t i = 0; i < spans.size(); ++i) {
    Eigen::MatrixXd rows(spans[i].to - spans[i].from, columns.cols() + 1);
    rows << columns.middleRows(spans[i].from, rows.rows()), e.segment(spans[i].from, rows.rows());
    EXPECT_TRUE(grams[i].isApprox(rows.transpose() * rows, 1e-9)) << i;
  }
}

// The mean square falls to the encoder's alone where the parameters are right.
TEST(FitModel, FindsTheParametersThatMadeTheRun) {
  constexpr double kStep_m = 2e-6;
  Parameters truth = parameters_of(simple_model());
  truth[Key::kMass] *= 1.1;
  truth[Key::kViscous] *= 0.8;
  truth[Key::kCoulomb] *= 1.2;
  truth[Key::kBias] = 0.3;
  const std::vector<study::diagnose::Run> runs{simulated_run(truth, 20, kStep_m)};
  const NominalModel stated = simple_model();
  const Data data = make_data(runs, stated);
  const Context context = make_context(stated, data);
  const Fitted fitted =
      fit_model(data, context, {parameters_of(stated), std::vector<OfRun>(1)},
                base_free_parameters(context, 1), kBandwidth, cut(data, kBandwidth), 20);
  for (const Key key : {Key::kMass, Key::kViscous, Key::kCoulomb, Key::kBias}) {
    EXPECT_NEAR(fitted.model.parameters[key], truth[key], 2e-3 * std::abs(truth[key]));
  }
  EXPECT_LT(root_mean_square(fitted.e), 0.35 * kStep_m);
}

// They agree with those of derivatives that are made once more, where the fit has ended.
TEST(FitModel, GivesTheProductsOfItsColumnsWhereItsLastStepIsSmall) {
  Parameters truth = parameters_of(simple_model());
  truth[Key::kMass] *= 1.1;
  truth[Key::kCoulomb] *= 1.2;
  const std::vector<study::diagnose::Run> runs{simulated_run(truth, 10, 2e-6),
                                               simulated_run(truth, 8, 2e-6)};
  const NominalModel stated = simple_model();
  const Data data = make_data(runs, stated);
  const Context context = make_context(stated, data);
  const auto free = base_free_parameters(context, 2);
  const auto spans = cut(data, kBandwidth);
  const auto fitted_in = [&](int rounds) {
    return fit_model(data, context, {parameters_of(stated), std::vector<OfRun>(2)}, free,
                     kBandwidth, spans, rounds);
  };
  EXPECT_TRUE(fitted_in(1).grams.empty()) << "the step was large";
  const Fitted fitted = fitted_in(20);
  const auto anew = grams_of(data, fitted.e, varied(fitted.model, free), kBandwidth, spans);
  ASSERT_EQ(fitted.grams.size(), anew.size());
  // Of each column with the error: as a correlation.
  const auto correlations = [](const std::vector<Eigen::MatrixXd>& grams) -> VectorXd {
    Eigen::MatrixXd sum = Eigen::MatrixXd::Zero(grams[0].rows(), grams[0].cols());
    for (const Eigen::MatrixXd& gram : grams) sum += gram;
    const VectorXd scale = sum.diagonal().cwiseSqrt().cwiseInverse();
    return scale.asDiagonal() * sum.rightCols(1) * scale.tail(1);
  };
  EXPECT_LT((correlations(fitted.grams) - correlations(anew)).cwiseAbs().maxCoeff(), 5e-5);
  for (std::size_t i = 0; i < anew.size(); ++i) {
    EXPECT_TRUE(fitted.grams[i].isApprox(anew[i], 1e-3)) << i;
  }
}

}  // namespace
}  // namespace towbench::tests
