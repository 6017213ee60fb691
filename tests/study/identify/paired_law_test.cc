// A law from the differences between a machine and a simulated reference whose law is known.
#include "study/identify/paired_law.h"

#include <cmath>

#include <gtest/gtest.h>

#include "core/random.h"

namespace towbench::study::identify {
namespace {

FrictionLaw reference_law() {
  FrictionLaw law;
  law.coulomb_Nm = 2e-3;
  law.excess_Nm = 1e-3;
  law.stribeck_rad_per_s = 6;
  law.viscous_Nm_s_per_rad = 1e-5;
  return law;
}

// Steady runs of a law, both ways. Slow ones read lower by what sticks and slips, a tenth of C, on
// every machine alike.
std::vector<SteadyRun> runs_of(const FrictionLaw& law, core::Random& random, double noise_Nm) {
  std::vector<SteadyRun> runs;
  for (double w = 0.7; w < 300; w *= 1.4) {
    const double stuck_Nm = w < 5 ? 2e-4 : 0;
    for (const double sign : {1.0, -1.0}) {
      runs.push_back({.speed_rad_per_s = sign * w,
                      .torque_Nm = sign * (law.at(w) - stuck_Nm + noise_Nm * random.gaussian()),
                      .standard_error_Nm = 1e-5});
    }
  }
  return runs;
}

TEST(PairedLaw, IsFoundThoughBothStickAndSlip) {
  auto of_machine = reference_law();
  of_machine.coulomb_Nm += 3e-5;
  of_machine.viscous_Nm_s_per_rad += 1e-7;
  of_machine.stribeck_rad_per_s += 0.02;
  core::Random random(2);
  const auto machine = runs_of(of_machine, random, 0);
  const auto shift =
      find_law_shift(reference_law(), 0, machine, runs_of(reference_law(), random, 0));
  ASSERT_TRUE(shift.found);
  EXPECT_NEAR(shift.coulomb_Nm, 3e-5, 1e-7);
  EXPECT_NEAR(shift.viscous_Nm_s_per_rad, 1e-7, 1e-9);
  EXPECT_NEAR(shift.stribeck_rad_per_s, 0.02, 1e-3);
  // Alone, the machine's own runs tell another law.
  EXPECT_GT(std::fabs(fit_friction_law(machine, 6, 1e-3).stribeck_rad_per_s - 6.02), 0.2);
}

TEST(PairedLaw, IsAsSureAsTheDifferencesAgree) {
  core::Random random(4);
  const auto quiet = find_law_shift(reference_law(), 0, runs_of(reference_law(), random, 1e-7),
                                    runs_of(reference_law(), random, 1e-7));
  const auto noisy = find_law_shift(reference_law(), 0, runs_of(reference_law(), random, 1e-5),
                                    runs_of(reference_law(), random, 1e-5));
  ASSERT_TRUE(quiet.found && noisy.found);
  EXPECT_GT(noisy.stribeck_standard_error, 20 * quiet.stribeck_standard_error);
  EXPECT_LT(std::fabs(noisy.stribeck_rad_per_s), 4 * noisy.stribeck_standard_error);
}

TEST(PairedLaw, IsLessSureWhereTheRiseToStandstillIs) {
  core::Random random(6);
  const auto machine = runs_of(reference_law(), random, 1e-7);
  const auto reference = runs_of(reference_law(), random, 1e-7);
  EXPECT_GT(find_law_shift(reference_law(), 1e-5, machine, reference).stribeck_standard_error,
            5 * find_law_shift(reference_law(), 0, machine, reference).stribeck_standard_error);
}

TEST(PairedLaw, IsNotFoundInFewerThanSixSpeeds) {
  core::Random random(2);
  auto machine = runs_of(reference_law(), random, 0);
  machine.resize(10);  // five speeds, both ways
  EXPECT_FALSE(find_law_shift(reference_law(), 0, machine, machine).found);
}

}  // namespace
}  // namespace towbench::study::identify
