// Real, measured data: the published figures first, then what a careful analyst finds in it.
#include <Eigen/QR>
#include <cstdlib>
#include <set>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "study/diagnose/diagnosis.h"
#include "study/identify/zero_phase_filter.h"
#include "tests/study/diagnose/emps_data.h"

namespace towbench::tests {
namespace {

using namespace study::diagnose;
using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;
using study::identify::central_difference;
using study::identify::ZeroPhaseFilter;

class Emps : public testing::Test {
 protected:
  void SetUp() override {
    if (!emps_is_there()) {
      GTEST_SKIP() << "EMPS data not found; set TOWBENCH_EMPS to the folder with DATA_EMPS.csv";
    }
  }
};

struct Regression {
  MatrixXd x;
  VectorXd y;
};

// The benchmark's own recipe: Butterworth 4 at 100 Hz, central differences, 49 samples off, then
// decimation by 10 through an order 8 Chebyshev filter at 40 Hz.
Regression published_recipe(const Run& run, bool asymmetric) {
  constexpr Index kDecimation = 10;
  const auto smooth = ZeroPhaseFilter::smooth(100, 1000);
  const auto sharp = ZeroPhaseFilter::sharp(40, 1000);
  const VectorXd q = smooth.apply(run.position_m);
  const VectorXd speed = central_difference(q, 1e-3);
  const Index n = q.size() - 49;
  const VectorXd a = central_difference(speed, 1e-3).tail(n);
  const VectorXd v = speed.tail(n);
  MatrixXd raw(n, asymmetric ? 5 : 4);
  raw.col(0) = a;
  if (asymmetric) {
    raw.col(1) = v.cwiseMax(0.0);
    raw.col(2) = v.cwiseMin(0.0);
    raw.col(3) = (v.array() > 0).cast<double>();
    raw.col(4) = (v.array() < 0).cast<double>();
  } else {
    raw.col(1) = v;
    raw.col(2) = v.array().sign();
    raw.col(3).setOnes();
  }
  const Index rows = (n + kDecimation - 1) / kDecimation;
  const Index first = kDecimation - (kDecimation * rows - n) - 1;
  const auto thin = [&](const VectorXd& column) {
    const VectorXd filtered = sharp.apply(column);
    VectorXd out(rows);
    for (Index i = 0; i < rows; ++i) {
      out[i] = filtered[first + i * kDecimation];
    }
    return out;
  };
  Regression r{MatrixXd(rows, raw.cols()), thin(run.input_N.tail(n))};
  for (Index j = 0; j < raw.cols(); ++j) {
    r.x.col(j) = thin(raw.col(j));
  }
  return r;
}

double relative_error_pct(const Regression& r, const VectorXd& theta) {
  return 100 * (r.y - r.x * theta).norm() / r.y.norm();
}

TEST_F(Emps, ThePublishedFourParametersAndErrorsComeOut) {
  const auto fit = published_recipe(emps_run("DATA_EMPS.csv"), false);
  const auto test = published_recipe(emps_run("DATA_EMPS_PULSES.csv"), false);
  const VectorXd theta = fit.x.colPivHouseholderQr().solve(fit.y);
  EXPECT_NEAR(theta[0], 95.1089, 1e-3);
  EXPECT_NEAR(theta[1], 203.5034, 1e-3);
  EXPECT_NEAR(theta[2], 20.3935, 1e-3);
  EXPECT_NEAR(theta[3], -3.1648, 1e-3);
  EXPECT_NEAR(relative_error_pct(fit, theta), 4.0834, 1e-3);
  EXPECT_NEAR(relative_error_pct(test, theta), 5.9824, 1e-3);
}

TEST_F(Emps, AsymmetricFrictionGivesTheKnownErrors) {
  const auto fit = published_recipe(emps_run("DATA_EMPS.csv"), true);
  const auto test = published_recipe(emps_run("DATA_EMPS_PULSES.csv"), true);
  const VectorXd theta = fit.x.colPivHouseholderQr().solve(fit.y);
  EXPECT_NEAR(relative_error_pct(fit, theta), 3.1117, 1e-3);
  EXPECT_NEAR(relative_error_pct(test, theta), 5.365, 1e-3);
}

Diagnosis diagnose_emps() {
  Request request;
  request.model.mass_kg = 95.1089;
  request.model.viscous_N_s_per_m = 203.5034;
  request.model.coulomb_N = 20.3935;
  request.model.bias_N = -3.1648;
  request.model.input_is_held = false;  // the published baseline has no hold
  request.runs = {emps_run("DATA_EMPS.csv")};
  request.holdout = {emps_run("DATA_EMPS_PULSES.csv")};
  return study::diagnose::diagnose(request);
}

bool names(const NamedCause& cause, const std::set<std::string>& wanted) {
  return wanted.contains(cause.effect->name) ||
         std::any_of(cause.alternatives.begin(), cause.alternatives.end(),
                     [&](const std::string& name) { return wanted.contains(name); });
}

// The analyst's ripple of the motor's turn lies above the band in which innovations are weighed.
TEST_F(Emps, WhatTheAnalystFoundBelowTheRippleIsNamedAndWhatIsNotThereIsNot) {
  const Diagnosis d = diagnose_emps();
  const std::vector<std::set<std::string>> wanted{
      {"transport_delay", "current_loop_lag"}, {"viscous_asymmetry"}, {"low_speed_rolloff"}};
  for (const auto& one : wanted) {
    const bool found = std::any_of(d.causes.begin(), d.causes.end(),
                                   [&](const NamedCause& cause) { return names(cause, one); });
    EXPECT_TRUE(found) << *one.begin();
  }
  for (const NamedCause& cause : d.causes) {
    EXPECT_FALSE(names(cause, {"stribeck", "cubic_viscous", "chain_elasticity"}))
        << cause.effect->name;
    EXPECT_GT(cause.gain99.low, 0) << cause.effect->name;
    if (cause.effect->name == "torque_ripple") {
      EXPECT_NEAR(cause.size("spatial_frequency_per_m"), 400, 4) << "once per motor turn";
    }
  }
  const Scored& scored = d.scored;
  EXPECT_GE(scored.gain95.value, 0.45) << scored.before_rms_N << " to " << scored.after_rms_N;
  EXPECT_LE(scored.gain95.value, 0.80) << "more than an analyst finds";
  EXPECT_GE(scored.gain95.low, 0.33);
}

}  // namespace
}  // namespace towbench::tests
