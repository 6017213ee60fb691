#include "harness/falsify/box_sampler.h"

#include <algorithm>
#include <array>

#include <gtest/gtest.h>

namespace towbench::harness {
namespace {

constexpr std::size_t kSamples = 400;
constexpr std::array<Stretch, 4> kStretches{{{0, 0.001}, {0.001, 0.5}, {0.5, 0.52}, {0.52, 1}}};

const std::vector<BoxSide> kTimeAndSize{
    {.has_ends = false, .stretches = {kStretches.begin(), kStretches.end()}}, {}};

std::vector<BoxSample> samples(const std::vector<BoxSide>& sides, std::uint64_t seed = 1) {
  BoxSampler sampler(sides, seed);
  std::vector<BoxSample> all(kSamples);
  std::generate(all.begin(), all.end(), [&] { return sampler.next(); });
  return all;
}

std::size_t count(const std::vector<BoxSample>& all, SampleKind kind) {
  return static_cast<std::size_t>(std::count_if(
      all.begin(), all.end(), [&](const BoxSample& sample) { return sample.kind == kind; }));
}

TEST(BoxSampler, MixesItsKindsWhereTheBoxHasThem) {
  const auto mixed = samples(kTimeAndSize);
  EXPECT_EQ(count(mixed, SampleKind::kUniform), 3 * kSamples / 10);
  EXPECT_EQ(count(mixed, SampleKind::kAtEnds), 2 * kSamples / 10);
  EXPECT_EQ(count(mixed, SampleKind::kOfStretch), 5 * kSamples / 10);
  EXPECT_EQ(count(samples({{.has_ends = false}}), SampleKind::kUniform), kSamples);
  EXPECT_EQ(count(samples({{}}), SampleKind::kAtEnds), 2 * kSamples / 10);
}

TEST(BoxSampler, AtEndsLeavesTimesWhereTheyAreDrawn) {
  std::size_t at_the_upper = 0;
  std::size_t at_ends = 0;
  for (const auto& sample : samples(kTimeAndSize)) {
    if (sample.kind == SampleKind::kAtEnds) {
      ++at_ends;
      EXPECT_TRUE(sample.point[1] == 0 || sample.point[1] == 1);
      EXPECT_TRUE(sample.point[0] > 0 && sample.point[0] < 1);
      at_the_upper += sample.point[1] == 1 ? 1U : 0U;
    }
  }
  EXPECT_GT(at_the_upper, at_ends / 3);
  EXPECT_LT(at_the_upper, 2 * at_ends / 3);
}

// 50 samples in each stretch, 11 to 14 in each quarter of it: evenly, where drawn ones would not
// be.
TEST(BoxSampler, FillsEachStretchAlikeAndEvenly) {
  std::array<std::array<std::size_t, 4>, 4> quarters{};
  for (const auto& sample : samples(kTimeAndSize, 7)) {
    if (sample.kind != SampleKind::kOfStretch) {
      continue;
    }
    std::size_t at = 0;
    while (sample.point[0] >= kStretches[at].to) {
      ++at;
    }
    const double share = (sample.point[0] - kStretches[at].from) / kStretches[at].length();
    ++quarters[at][std::min<std::size_t>(3, static_cast<std::size_t>(4 * share))];
  }
  for (const auto& of_stretch : quarters) {
    EXPECT_EQ(of_stretch[0] + of_stretch[1] + of_stretch[2] + of_stretch[3], 50U);
    for (const auto quarter : of_stretch) {
      EXPECT_GE(quarter, 11U);
      EXPECT_LE(quarter, 14U);
    }
  }
}

TEST(BoxSampler, DrawsTheSameWithTheSameSeedAndOthersWithAnother) {
  const auto points = [](std::uint64_t seed) {
    std::vector<BoxPoint> all;
    for (const auto& sample : samples(kTimeAndSize, seed)) {
      all.push_back(sample.point);
    }
    return all;
  };
  EXPECT_EQ(points(3), points(3));
  EXPECT_NE(points(3), points(4));
}

}  // namespace
}  // namespace towbench::harness
