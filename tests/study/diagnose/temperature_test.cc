// A log with a measured temperature: friction that follows it is named with its slopes, and is not
// where only the temperature changes.
#include <cmath>
#include <random>
#include <string>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "study/diagnose/diagnosis.h"
#include "study/diagnose/headline.h"
#include "tests/study/diagnose/cause_names.h"

namespace towbench::tests {
namespace {

using namespace study::diagnose;
using ::testing::ElementsAre;
using ::testing::IsEmpty;

constexpr double kMass_kg = 20;
constexpr double kViscous_N_s_per_m = 60;
constexpr double kCoulomb_N = 25;
constexpr double kMean_C = 40;

struct Slopes {
  double dry_N_per_K = 0;
  double viscous_N_s_per_m_per_K = 0;
};

// Semi-implicit steps of 0.1 ms, a controller at 1 kHz, counts of 5 um, a sensor of 0.1 K. It warms
// up, is left to cool, and warms up again.
Run run_of(const Slopes& fall, std::uint64_t seed) {
  std::mt19937_64 draw(seed);
  std::uniform_real_distribution<double> phase(0, 6.28);
  const double first = phase(draw);
  const double second = phase(draw);
  constexpr int kSamples = 40000;
  constexpr double kPeriod_s = 1e-3;
  Run run;
  run.name = "warming";
  run.period_s = kPeriod_s;
  run.resolution_m = 5e-6;
  run.position_m.resize(kSamples);
  run.input_N.resize(kSamples);
  run.temperature_K.resize(kSamples);
  run.missing.assign(kSamples, 0);
  double x = 0;
  double v = 0;
  double before = 0;
  double celsius = 25;
  for (int k = 0; k < kSamples; ++k) {
    const double t = k * kPeriod_s;
    const double reference = 0.15 * std::sin(2 * t + first) + 0.05 * std::sin(5.3 * t + second);
    const double read = std::floor(x / 5e-6) * 5e-6;
    const double input = 6000 * (reference - read) - 500 * (read - before) / kPeriod_s;
    before = read;
    run.position_m[k] = read;
    run.input_N[k] = input;
    run.temperature_K[k] = std::round(10 * celsius) / 10;
    const double ambient_C = t > 15 && t < 25 ? 20 : 65;
    celsius += kPeriod_s / 12 * (ambient_C - celsius);
    const double dry_N = kCoulomb_N - fall.dry_N_per_K * (celsius - kMean_C);
    const double b = kViscous_N_s_per_m - fall.viscous_N_s_per_m_per_K * (celsius - kMean_C);
    for (int i = 0; i < 10; ++i) {
      v += 1e-4 / kMass_kg * (input - b * v - dry_N * std::tanh(v / 1e-4));
      x += 1e-4 * v;
    }
  }
  return run;
}

Diagnosis diagnosed(const Slopes& fall, std::uint64_t seed) {
  Request request;
  request.model.mass_kg = kMass_kg;
  request.model.viscous_N_s_per_m = kViscous_N_s_per_m;
  request.model.coulomb_N = kCoulomb_N;
  request.runs.push_back(run_of(fall, seed));
  return study::diagnose::diagnose(request);
}

TEST(Temperature, FrictionThatFallsWithItIsNamedWithItsSlopes) {
  const Diagnosis d = diagnosed({0.3, 0.8}, 1);
  ASSERT_THAT(cause_names(d), ElementsAre("temperature_friction")) << headline(d);
  EXPECT_NEAR(d.causes.front().size("dry_fall_N_per_K"), 0.3, 0.03);
  EXPECT_NEAR(d.causes.front().size("viscous_fall_N_s_per_m_per_K"), 0.8, 0.08);
}

TEST(Temperature, IsNoCauseWhereFrictionStays) {
  const Diagnosis d = diagnosed({}, 2);
  EXPECT_THAT(cause_names(d), IsEmpty()) << headline(d);
}

}  // namespace
}  // namespace towbench::tests
