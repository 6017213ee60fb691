// The search on functions whose smallest value is known.
#include "harness/falsify/box_search.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include <gtest/gtest.h>

namespace towbench::harness {
namespace {

// A narrow funnel at (0.37, 0.81) in a wide one at (0.8, 0.2): smallest value -2.
double two_funnels(const BoxPoint& x) {
  const double near = std::hypot(x[0] - 0.37, x[1] - 0.81);
  const double far = std::hypot(x[0] - 0.8, x[1] - 0.2);
  return std::min(-2 + 10 * near, -1 + far);
}

const std::vector<BoxSide> kTwo(2, {.has_ends = false});

BoxSearchResult search(Optimiser optimiser, std::uint64_t seed, std::size_t runs = 200) {
  return search_box({.sides = kTwo, .runs = runs, .seed = seed, .optimiser = optimiser},
                    [](const BoxTrial& trial) { return two_funnels(trial.point); });
}

TEST(BoxSearch, FindsTheNarrowFunnelWithFewRunsWhereSamplesComeNoNearer) {
  std::size_t by_optimiser = 0;
  std::size_t by_samples = 0;
  for (std::uint64_t seed = 1; seed <= 20; ++seed) {
    const auto chosen = search(Optimiser::kSubplex, seed);
    const auto sampled = search(Optimiser::kUniform, seed);
    by_optimiser += *chosen.trials[*chosen.best].value < -1.99 ? 1U : 0U;
    by_samples += *sampled.trials[*sampled.best].value < -1.99 ? 1U : 0U;
  }
  EXPECT_GE(by_optimiser, 18U);
  EXPECT_LE(by_samples, 4U);
}

TEST(BoxSearch, TriesTheSamePointsWithTheSameSeedAndOthersWithAnother) {
  for (const auto optimiser : {Optimiser::kUniform, Optimiser::kSubplex, Optimiser::kCrs,
                               Optimiser::kDirect, Optimiser::kEsch}) {
    const auto points = [&](std::uint64_t seed) {
      std::vector<BoxPoint> all;
      for (const auto& trial : search(optimiser, seed, 60).trials) {
        all.push_back(trial.point);
      }
      return all;
    };
    EXPECT_EQ(points(3), points(3));
    EXPECT_NE(points(3), points(4));
  }
}

TEST(BoxSearch, KeepsToItsRunsItsBoxAndItsShareOfSamples) {
  for (const auto optimiser :
       {Optimiser::kSubplex, Optimiser::kCrs, Optimiser::kDirect, Optimiser::kEsch}) {
    const auto found = search(optimiser, 1, 100);
    EXPECT_EQ(found.trials.size(), 100U);
    std::size_t samples = 0;
    for (const auto& trial : found.trials) {
      samples += trial.sample ? 1U : 0U;
      for (const double x : trial.point) {
        EXPECT_GE(x, 0.0);
        EXPECT_LE(x, 1.0);
      }
    }
    EXPECT_EQ(samples, 50U);
  }
}

// The narrow funnel has been looked into: the optimiser goes to the other one.
TEST(BoxSearch, BeginsNoMoreWhereItHasBegun) {
  const std::vector<BoxTrial> known{
      {.point = {0.38, 0.8}, .value = two_funnels({0.38, 0.8}), .sample = SampleKind::kUniform},
      {.point = {0.7, 0.3}, .value = two_funnels({0.7, 0.3}), .sample = SampleKind::kUniform}};
  const auto found = search_box(
      {.sides = kTwo, .runs = 30, .sampled_share = 0, .known = known, .begun = {{0.37, 0.81}}},
      [](const BoxTrial& trial) { return two_funnels(trial.point); });
  EXPECT_EQ(found.begun.size(), 2U);
  EXPECT_EQ(found.begun.back(), known[1].point);
  EXPECT_NEAR(found.trials[*found.best].point[0], 0.8, 0.05);
}

// -1 at one moment in a stretch of a thousandth, for the larger sizes, and 0 elsewhere: no slope
// leads there.
double needle(const BoxPoint& x) {
  return x[0] > 0.4006 && x[0] < 0.4009 ? -x[1] : 0;
}

TEST(BoxSearch, FindsAMomentInAShortStretchThatUniformSamplesMiss) {
  const std::vector<BoxSide> sides{
      {.has_ends = false, .stretches = {{0, 0.4}, {0.4, 0.401}, {0.401, 1}}}, {}};
  const auto seeds_that_find = [&](Optimiser optimiser) {
    std::size_t found = 0;
    for (std::uint64_t seed = 1; seed <= 20; ++seed) {
      const auto result =
          search_box({.sides = sides, .runs = 200, .seed = seed, .optimiser = optimiser},
                     [](const BoxTrial& trial) { return needle(trial.point); });
      found += *result.trials[*result.best].value < -0.98 ? 1U : 0U;
    }
    return found;
  };
  EXPECT_GE(seeds_that_find(Optimiser::kSubplex), 18U);
  EXPECT_LE(seeds_that_find(Optimiser::kUniform), 3U);
}

TEST(BoxSearch, WhereTheFunctionIsUndefinedIsNoBest) {
  const auto nothing = search_box({.sides = kTwo, .runs = 40},
                                  [](const BoxTrial&) { return std::optional<double>(); });
  EXPECT_FALSE(nothing.best);
  EXPECT_EQ(nothing.trials.size(), 40U);
  const auto half =
      search_box({.sides = kTwo, .runs = 100}, [](const BoxTrial& trial) -> std::optional<double> {
        return trial.point[0] < 0.5 ? std::nullopt : std::optional(two_funnels(trial.point));
      });
  EXPECT_LT(*half.trials[*half.best].value, -0.98);
  EXPECT_GE(half.trials[*half.best].point[0], 0.5);
}

TEST(BoxSearch, EndsAtTheFirstValueBelowItsLimit) {
  const auto found = search_box({.sides = kTwo, .runs = 500, .stop_below = -1.5},
                                [](const BoxTrial& trial) { return two_funnels(trial.point); });
  EXPECT_LT(found.trials.size(), 500U);
  EXPECT_EQ(*found.best + 1, found.trials.size());
}

TEST(BoxSearch, LetsThroughWhatTheFunctionThrows) {
  std::size_t calls = 0;
  EXPECT_THROW((void)search_box({.sides = kTwo, .runs = 100},
                                [&](const BoxTrial& trial) {
                                  if (++calls > 70) {
                                    throw std::out_of_range("71st");
                                  }
                                  return std::optional(two_funnels(trial.point));
                                }),
               std::out_of_range);
}

}  // namespace
}  // namespace towbench::harness
