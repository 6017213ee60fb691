// Against a motion in closed form that an encoder of coarse steps reads.
#include "study/diagnose/fine_motion.h"

#include <cmath>
#include <numbers>

#include <gtest/gtest.h>

#include "study/diagnose/context.h"
#include "study/diagnose/dataset.h"

namespace towbench::harness::diagnose {
namespace {

using Eigen::ArrayXd;
using Eigen::Index;
using Eigen::VectorXd;

constexpr Index kLongRows = 12'000;
constexpr double kPeriod_s = 1e-3;
constexpr double kStep_m = 5e-6;
constexpr double kMass_kg = 8;
constexpr double kViscous_N_s_per_m = 5;
constexpr double kCoulomb_N = 1.5;

// Slow to and fro with a fast part on it, too small for the encoder to follow its acceleration.
struct ClosedForm {
  ArrayXd t_s = ArrayXd::LinSpaced(kLongRows, 0, (kLongRows - 1) * kPeriod_s);
  ArrayXd position_m = part(0, 0.2, 0.4) + part(0, 2e-6, 31);
  ArrayXd speed_m_per_s = part(1, 0.2, 0.4) + part(1, 2e-6, 31);
  ArrayXd acceleration_m_per_s2 = part(2, 0.2, 0.4) + part(2, 2e-6, 31);

  // Of a sine the derivative of that order.
  [[nodiscard]] ArrayXd part(int order, double amplitude_m, double hertz) const {
    const double w = 2 * std::numbers::pi * hertz;
    return amplitude_m * std::pow(w, order) * (w * t_s + order * std::numbers::pi / 2).sin();
  }
};

NominalModel model() {
  NominalModel m;
  m.mass_kg = kMass_kg;
  m.viscous_N_s_per_m = kViscous_N_s_per_m;
  m.coulomb_N = kCoulomb_N;
  m.input_is_held = false;
  return m;
}

std::vector<Run> logged(const ClosedForm& truth) {
  Run run;
  run.name = "closed form";
  run.period_s = kPeriod_s;
  run.resolution_m = kStep_m;
  run.position_m = ((truth.position_m / kStep_m).floor() + 0.5) * kStep_m;
  run.input_N = kMass_kg * truth.acceleration_m_per_s2 + kViscous_N_s_per_m * truth.speed_m_per_s +
                kCoulomb_N * truth.speed_m_per_s.sign();
  run.missing.assign(static_cast<std::size_t>(kLongRows), 0);
  return {run};
}

bool at_every_row(Index /*row*/, Index /*rows*/) {
  return true;
}

Dataset dataset_of(const std::vector<Run>& runs) {
  return make_dataset(runs, choose_conditioning(runs, model()), stated_baseline(model()),
                      at_every_row);
}

// Away from the ends, where filters begin.
double rms_off(const VectorXd& found, const ArrayXd& truth) {
  const Index border = kLongRows / 10;
  return std::sqrt((found.array() - truth).segment(border, kLongRows - 2 * border).square().mean());
}

TEST(FineMotion, HasLessOfTheEncodersStepsThanTheMeasuredOne) {
  const ClosedForm truth;
  const Dataset data = dataset_of(logged(truth));
  const Context context = make_context(model(), data);
  const Signals& s = data.members.front().signals;
  const double measured = rms_off(s.acceleration_m_per_s2, truth.acceleration_m_per_s2);
  const double fine = rms_off(fine_acceleration_m_per_s2(s, context), truth.acceleration_m_per_s2);
  EXPECT_LT(fine, 0.2 * measured);
  const FineMotion motion = fine_motion(s, context);
  EXPECT_LT(rms_off(motion.speed_m_per_s, truth.speed_m_per_s),
            0.5 * rms_off(s.speed_m_per_s, truth.speed_m_per_s));
  EXPECT_LT(rms_off(motion.position_m, truth.position_m),
            0.5 * rms_off(s.position_m, truth.position_m));
}

TEST(FineMotion, IsTheMeasuredOneWhereTheModelHasNoMass) {
  const Dataset data = dataset_of(logged({}));
  Context context = make_context(model(), data);
  context.theta[kMass] = 0;
  const Signals& s = data.members.front().signals;
  EXPECT_EQ(fine_acceleration_m_per_s2(s, context), s.acceleration_m_per_s2);
}

}  // namespace
}  // namespace towbench::harness::diagnose
