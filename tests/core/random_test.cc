#include "core/random.h"

#include <array>
#include <cmath>

#include <gtest/gtest.h>

namespace towbench::core {
namespace {

// xoshiro256plusplus.c and splitmix64.c of prng.di.unimi.it: first outputs for seeds 0 and 42.
TEST(Random, MatchesTheReferenceImplementation) {
  constexpr std::array<std::uint64_t, 5> kSeed0{0x53175d61490b23df, 0x61da6f3dc380d507,
                                                0x5c0fdf91ec9a7bfc, 0x02eebf8c3bbe5e1a,
                                                0x7eca04ebaf4a5eea};
  constexpr std::array<std::uint64_t, 5> kSeed42{0xd0764d4f4476689f, 0x519e4174576f3791,
                                                 0xfbe07cfb0c24ed8c, 0xb37d9f600cd835b8,
                                                 0xcb231c3874846a73};
  Random zero(0);
  Random forty_two(42);
  for (std::size_t i = 0; i < kSeed0.size(); ++i) {
    EXPECT_EQ(zero.bits(), kSeed0[i]);
    EXPECT_EQ(forty_two.bits(), kSeed42[i]);
  }
}

TEST(Random, CanBeUsedWhileCompiling) {
  static_assert(Random(0).bits() == 0x53175d61490b23df);
  static_assert(Random(1).uniform() < 1.0);
}

// Bounds at five standard errors of the mean and of the variance.
TEST(Random, UniformNumbersFillTheUnitInterval) {
  Random random(3);
  constexpr int kCount = 200'000;
  double sum = 0.0;
  double squares = 0.0;
  for (int i = 0; i < kCount; ++i) {
    const double u = random.uniform();
    ASSERT_GE(u, 0.0);
    ASSERT_LT(u, 1.0);
    sum += u;
    squares += (u - 0.5) * (u - 0.5);
  }
  EXPECT_NEAR(sum / kCount, 0.5, 5.0 * std::sqrt(1.0 / 12.0 / kCount));
  EXPECT_NEAR(squares / kCount, 1.0 / 12.0, 5.0 * std::sqrt(1.0 / 180.0 / kCount));
}

TEST(Random, GaussianNumbersHaveTheStatedMomentsAndBound) {
  Random random(4);
  constexpr int kCount = 200'000;
  double sum = 0.0;
  double squares = 0.0;
  int within_one = 0;
  for (int i = 0; i < kCount; ++i) {
    const double g = random.gaussian();
    ASSERT_LE(std::abs(g), 6.0);
    sum += g;
    squares += g * g;
    within_one += std::abs(g) < 1.0 ? 1 : 0;
  }
  EXPECT_NEAR(sum / kCount, 0.0, 5.0 / std::sqrt(kCount));
  EXPECT_NEAR(squares / kCount, 1.0, 5.0 * std::sqrt(2.0 / kCount));
  EXPECT_NEAR(static_cast<double>(within_one) / kCount, 0.6827, 0.01);
}

}  // namespace
}  // namespace towbench::core
