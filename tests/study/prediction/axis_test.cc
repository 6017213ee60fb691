// The axis that predicts, against closed forms.
#include "study/prediction/axis.h"

#include <cmath>
#include <numbers>
#include <utility>

#include <gtest/gtest.h>

namespace towbench::tests {
namespace {

using namespace study::diagnose;
using Eigen::Index;
using Eigen::VectorXd;

constexpr double kPeriod_s = 1e-3;
constexpr double kMass_kg = 8;

double time_of(Index k) {
  return kPeriod_s * static_cast<double>(k);
}

// An axis that begins at rest at 0, or where it is placed, and what its encoder reads.
class Stepped {
 public:
  Stepped(const Parameters& parameters, const VectorXd& input_N)
      : Stepped(parameters, run_of(input_N)) {}
  Stepped(const Parameters& parameters, Run run)
      : run_(std::move(run)), scene_(run_, stated_), axis_(parameters, scene_) {
    axis_.place(0, 0);
  }
  static Run run_of(const VectorXd& input_N) {
    Run run;
    run.period_s = kPeriod_s;
    run.input_N = input_N;
    run.position_m = VectorXd::Zero(input_N.size());
    return run;
  }
  Axis& axis() { return axis_; }
  // After `count` more periods.
  double after(Index count) {
    for (Index i = 0; i < count; ++i) axis_.step(k_++);
    return axis_.reading_m();
  }

 private:
  NominalModel stated_;
  Run run_;
  Scene scene_;
  Axis axis_;
  Index k_ = 0;
};

Parameters free_body() {
  Parameters p;
  p[Key::kMass] = kMass_kg;
  return p;
}

// A quarter of the mass turns with the motor.
Parameters two_bodies(double held_Hz, double damping_ratio) {
  Parameters p = free_body();
  const double load_kg = 0.75 * kMass_kg;
  const double w = 2 * M_PI * held_Hz;
  p[Key::kMotorMass] = 0.25 * kMass_kg;
  p[Key::kStiffness] = load_kg * w * w;
  p[Key::kDamping] = 2 * damping_ratio * load_kg * w;
  return p;
}

// Drive and load pull against each other: the spring stretches by F / K, and the centre of both
// bodies stays.
TEST(Axis, AnotherAxisActsOnTheLoad) {
  constexpr double kForce_N = 4;
  constexpr double kOther_kg = 2;
  Parameters p = two_bodies(2, 0.5);
  p[key_of(0, OtherKey::kMass)] = kOther_kg;
  study::diagnose::Run run = Stepped::run_of(VectorXd::Constant(2000, kForce_N));
  const VectorXd t = VectorXd::LinSpaced(2000, 0, 2000 - 1) * kPeriod_s;
  run.others.push_back({0.5 * kForce_N / kOther_kg * t.cwiseAbs2(), false});
  // Its acceleration is not there in the first 20 ms: what both have moved on by then.
  const double before = Stepped(p, run).after(1800);
  const double later = Stepped(p, run).after(1900);
  const double drift = (later - before) / 0.1 * 1.85;
  EXPECT_NEAR(0.5 * (before + later) - drift, 0.75 * kForce_N / p[Key::kStiffness], 2e-4);
}

// v0^2 M / 2 C.
TEST(Axis, CoastsAsFarAsDryFrictionLetsIt) {
  Parameters p = free_body();
  p[Key::kCoulomb] = 3;
  Stepped body(p, VectorXd::Zero(1500));
  body.axis().place(0.1, 0.4);
  EXPECT_NEAR(body.after(1500), 0.1 + 0.4 * 0.4 * kMass_kg / (2 * 3), 1e-6);
  EXPECT_EQ(body.axis().speed_m_per_s(), 0);
}

// v0 M / B.
TEST(Axis, CoastsAsFarAsViscousFrictionLetsIt) {
  Parameters p = free_body();
  p[Key::kViscous] = 16;
  Stepped body(p, VectorXd::Zero(8000));
  body.axis().place(0, 0.4);
  EXPECT_NEAR(body.after(8000), 0.4 * kMass_kg / 16, 1e-4);
}

TEST(Axis, StandsBelowItsDryFrictionAndLeavesAboveIt) {
  Parameters p = free_body();
  p[Key::kCoulomb] = 3;
  EXPECT_EQ(Stepped(p, VectorXd::Constant(1000, 2.99)).after(1000), 0);
  EXPECT_EQ(Stepped(p, VectorXd::Constant(1000, -2.99)).after(1000), 0);
  EXPECT_NEAR(Stepped(p, VectorXd::Constant(1000, 3.5)).after(1000), 0.5 * 0.5 / kMass_kg, 1e-4);
}

// Drag opposes motion: v = v0 / (1 + D v0 t / M).
TEST(Axis, DragActsAgainstTheMotionBothWays) {
  Parameters p = free_body();
  p[Key::kDrag] = 20;
  const double way = kMass_kg / 20 * std::log(1 + 20 * 0.4 * 2 / kMass_kg);
  for (const double sign : {1.0, -1.0}) {
    Stepped body(p, VectorXd::Zero(2000));
    body.axis().place(0, sign * 0.4);
    EXPECT_NEAR(body.after(2000), sign * way, 1e-4);
  }
}

TEST(Axis, KeepsItsEnergyWithoutFriction) {
  Parameters p = free_body();
  p[Key::kCable] = 200;  // w = 5 rad/s about the middle of the stroke, 0.5 m
  Stepped body(p, VectorXd::Zero(20000));
  body.axis().place(0.7, 0);
  const double energy = 0.5 * 200 * 0.2 * 0.2;
  for (Index k = 0; k < 20000; k += 100) {
    const double stretch = body.after(100) - 0.5;
    const double v = body.axis().speed_m_per_s();
    ASSERT_NEAR(0.5 * kMass_kg * v * v + 0.5 * 200 * stretch * stretch, energy, 1e-5 * energy);
  }
  EXPECT_NEAR(body.axis().reading_m(), 0.5 + 0.2 * std::cos(5 * 20.0), 2e-5);
}

// x = F t^2 / 2 M + F mL / (M mM w^2) (1 - cos w t), w the free mode.
TEST(Axis, TwoBodiesSwingAtTheirMode) {
  const Parameters p = two_bodies(4, 0);
  const double mode = 2 * M_PI * 4 * std::sqrt(kMass_kg / p[Key::kMotorMass]);
  constexpr double kForce_N = 10;
  const double swing_m = kForce_N * 0.75 / (p[Key::kMotorMass] * mode * mode);
  Stepped bodies(p, VectorXd::Constant(2000, kForce_N));
  for (Index k = 10; k <= 2000; k += 10) {
    const double t = time_of(k);
    const double truth = kForce_N * t * t / (2 * kMass_kg) + swing_m * (1 - std::cos(mode * t));
    ASSERT_NEAR(bodies.after(10), truth, 0.02 * swing_m) << t;
  }
}

TEST(Axis, InsideItsPlayTheMotorGoesAlone) {
  Parameters p = two_bodies(50, 0.4);
  p[Key::kPlay] = 2e-3;
  constexpr double kForce_N = 0.4;
  Stepped bodies(p, VectorXd::Constant(3000, kForce_N));
  const auto flank =
      static_cast<Index>(std::sqrt(p[Key::kPlay] * p[Key::kMotorMass] / kForce_N) / kPeriod_s);
  const double t = time_of(flank);
  EXPECT_NEAR(bodies.after(flank), kForce_N * t * t / (2 * p[Key::kMotorMass]), 1e-9);
  // Behind the flank it takes the load along.
  bodies.after(3000 - flank);
  EXPECT_NEAR(bodies.axis().speed_m_per_s(), kForce_N * time_of(3000) / kMass_kg, 1e-3);
}

// Half a sample more than four: the force of a held input may change within a period.
TEST(Axis, ADelayMovesTheInputByItsOwnLength) {
  Parameters p = free_body();
  p[Key::kDelay] = 4.5e-3;
  VectorXd input_N = VectorXd::Zero(500);
  input_N.tail(400).setConstant(8);
  const double pushed_s = 0.4 - p[Key::kDelay];
  EXPECT_NEAR(Stepped(p, input_N).after(500), 8 * pushed_s * pushed_s / (2 * kMass_kg), 1e-6);
}

// Of a ramp the lag's force is behind by its time constant.
TEST(Axis, ALagIsBehindARampByItsTimeConstant) {
  Parameters p = free_body();
  p[Key::kLag] = 5e-3;
  const VectorXd ramp_N = VectorXd::LinSpaced(1001, 0, 10);
  Stepped lagged(p, ramp_N);
  Stepped prompt(free_body(), ramp_N);
  lagged.after(1000);
  prompt.after(1000);
  EXPECT_NEAR(prompt.axis().speed_m_per_s() - lagged.axis().speed_m_per_s(),
              10 * p[Key::kLag] / kMass_kg, 1e-3 * 10 * p[Key::kLag]);
}

// Dahl's law of a body that is pulled slowly over its bristles and back: the force it takes follows
// the way, C (1 - e^(-x / s)) from rest and C (2 e^(-x / s) - 1) behind the turn.
TEST(Axis, BristlesTakeAForceThatFollowsTheWay) {
  Parameters p = free_body();
  p[Key::kCoulomb] = 3;
  p[Key::kPresliding] = 6;
  p[Key::kPreslidingTravel] = 2e-3;
  p[Key::kCable] = 500;  // from 0.5 m, where it is placed
  p[Key::kViscous] = 400;
  // 500 x + F(x) = u, so slow that inertia and damping are small.
  VectorXd input_N = VectorXd::Zero(80'000);
  const auto force_N = [](double way_m, bool back) {
    const double gone = std::exp(-way_m / 2e-3);
    return back ? 3 * (2 * gone - 1) : 3 * (1 - gone);
  };
  for (Index k = 0; k < 40'000; ++k) input_N[k] = 8 * time_of(k) / 40;
  for (Index k = 40'000; k < 80'000; ++k) input_N[k] = 8 - 8 * (time_of(k) - 40) / 40;
  Stepped body(p, input_N);
  body.axis().place(0.5, 0);
  double turned_m = 0;
  for (Index k = 1000; k <= 80'000; k += 1000) {
    const double way_m = body.after(1000) - 0.5;
    turned_m = std::max(turned_m, way_m);
    const double taken_N = input_N[k - 1] - 500 * way_m;
    const bool back = k > 42'000;
    if (k < 38'000 || back) {
      ASSERT_NEAR(taken_N, force_N(back ? turned_m - way_m : way_m, back), 0.25) << k;
    }
  }
}

// About z = 0 a body on bristles is one on a spring C / l and a damper C T / l: let go a little off
// its place of rest, it swings on below its first overshoot exp(-pi zeta / sqrt(1 - zeta^2)).
TEST(Axis, BristlesDampASmallSwing) {
  constexpr double kTravel_m = 2e-3;
  constexpr double kZeta = 0.2;
  Parameters p = free_body();
  p[Key::kCoulomb] = 30;
  p[Key::kPresliding] = 60;
  p[Key::kPreslidingTravel] = kTravel_m;
  const double pulsation = std::sqrt(30 / kTravel_m / kMass_kg);
  p[Key::kPreslidingTime] = 2 * kZeta / pulsation;
  constexpr double kForce_N = 0.03;  // a step: from rest it swings about F l / C
  Stepped body(p, VectorXd::Constant(2000, kForce_N));
  const double rest_m = kForce_N * kTravel_m / 30;
  double most_m = 0;
  for (Index k = 0; k < 200; ++k) most_m = std::max(most_m, body.after(1));
  const double over = std::exp(-std::numbers::pi * kZeta / std::sqrt(1 - kZeta * kZeta));
  EXPECT_NEAR(most_m / rest_m, 1 + over, 0.02);
  EXPECT_NEAR(body.after(1800) / rest_m, 1, 0.02);
}

// A wheel out of round by w(x) = e cos(k x): energy of the load is M (1 + w)^2 v^2 / 2.
TEST(Axis, BehindAWheelOutOfRoundTheLoadKeepsItsEnergy) {
  Parameters p = free_body();
  p[Key::kWheelPerMetre] = 4;
  p[Key::kWheelCosine] = 0.1;
  Stepped body(p, VectorXd::Zero(1000));
  body.axis().place(0, 0.4);
  const auto excess = [](double x) { return 1 + 0.1 * std::cos(2 * M_PI * 4 * x); };
  const double energy = std::pow(excess(0) * 0.4, 2);
  for (int i = 0; i < 20; ++i) {
    const double x = body.after(50);
    const double v = body.axis().speed_m_per_s();
    ASSERT_NEAR(std::pow(excess(x) * v, 2), energy, 2e-3 * energy) << x;
  }
}

}  // namespace
}  // namespace towbench::tests
