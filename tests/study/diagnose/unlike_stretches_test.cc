// Which stretches are put aside, and when the answer of the rest is taken for that of all, by
// answers that are made up.
#include "study/diagnose/unlike_stretches.h"

#include <string>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace towbench::study::diagnose {
namespace {

using ::testing::ElementsAre;
using ::testing::IsEmpty;
using ::testing::SizeIs;

using Windows = std::vector<double>;

// What is answered, round by round; the last one again and again.
struct MadeUpRest {
  std::vector<Windows> left{{1, 1, 1, 1, 1, 1, 1, 1, 1, 1, 1, 1}};
  double unlike = 3;  // times what the rest lacks
  bool is_unexplained = false;
  std::vector<std::vector<Stretch>> asked{};
};
MadeUpRest made_up_rest;

Diagnosis with_windows(const Windows& windows, bool is_unexplained) {
  Diagnosis d;
  d.windows_m = {windows};
  if (is_unexplained) d.unexplained.emplace();
  d.verdicts.emplace_back(is_unexplained ? "unexplained_structure" : "model_adequate");
  return d;
}

Diagnosis of_rest(const Request& request) {
  MadeUpRest& m = made_up_rest;
  Diagnosis d = with_windows(m.left[std::min(m.asked.size(), m.left.size() - 1)], m.is_unexplained);
  m.asked.push_back(request.stretches);
  d.aside = {{m.unlike * 0.2}, 0.2};
  return d;
}

// Windows of 25 samples; the last one is shorter.
std::optional<Diagnosis> without_stretches(const Diagnosis& all, const MadeUpRest& rest = {}) {
  made_up_rest = rest;
  Request request;
  Run& run = request.runs.emplace_back();
  run.name = "a";
  run.period_s = 0.01;
  run.position_m = Eigen::VectorXd::Zero(25 * std::ssize(all.windows_m[0]) - 10);
  return without_unlike_stretches(request, all, of_rest);
}

std::vector<std::pair<Eigen::Index, Eigen::Index>> asked_last() {
  std::vector<std::pair<Eigen::Index, Eigen::Index>> out;
  if (made_up_rest.asked.empty()) return out;
  for (const Stretch& s : made_up_rest.asked.back()) out.emplace_back(s.from, s.to);
  return out;
}

constexpr bool kUnexplained = true;

TEST(WithoutUnlikeStretches, OneIsThreeTimesTheMedianForTwoWindowsAndOneOnEitherSide) {
  without_stretches(with_windows({1, 1, 1, 1, 3.1, 3.1, 1, 1, 1, 1, 1, 1}, kUnexplained));
  EXPECT_THAT(asked_last(), ElementsAre(std::pair(75, 175)));
  without_stretches(with_windows({1, 1, 1, 1, 2.9, 3.1, 1, 1, 1, 1, 1, 1}, kUnexplained));
  EXPECT_THAT(asked_last(), IsEmpty());
}

TEST(WithoutUnlikeStretches, OneReachesOverAWindowInWhichThePushTurnsOver) {
  without_stretches(with_windows({1, 1, 1, 1, 4, 1, 4, 1, 1, 1, 1, 1}, kUnexplained));
  EXPECT_THAT(asked_last(), ElementsAre(std::pair(75, 200)));
  without_stretches(with_windows({1, 1, 1, 1, 4, 1, 1, 4, 1, 1, 1, 1}, kUnexplained));
  EXPECT_THAT(asked_last(), IsEmpty());
}

TEST(WithoutUnlikeStretches, TheyEndWithTheRun) {
  without_stretches(with_windows({4, 4, 1, 1, 1, 1, 1, 1, 1, 1, 4, 4}, kUnexplained));
  EXPECT_THAT(asked_last(), ElementsAre(std::pair(0, 75), std::pair(225, 290)));
}

TEST(WithoutUnlikeStretches, NoneIsMostOfARun) {
  EXPECT_FALSE(without_stretches(with_windows({1, 1, 4, 4, 1, 4, 4, 4, 1, 1, 1, 1}, kUnexplained)));
  EXPECT_THAT(made_up_rest.asked, IsEmpty());
}

const Windows kFirst{1, 1, 1, 9, 9, 1, 1, 1, 1, 1, 1, 1, 1, 1};

TEST(WithoutUnlikeStretches, WhatTheFirstHideIsPutAsideToo) {
  MadeUpRest rest;
  rest.left = {{.9, .9, 0, 0, 0, 0, .9, .9, 4, 4, .9, .9, .9, .9}, kFirst};
  EXPECT_TRUE(without_stretches(with_windows(kFirst, kUnexplained), rest));
  EXPECT_THAT(made_up_rest.asked, SizeIs(2));
  EXPECT_THAT(asked_last(), ElementsAre(std::pair(50, 150), std::pair(175, 275)));
}

// New ones of a model that is no better are no hand's.
TEST(WithoutUnlikeStretches, NoneIsSoughtWhereTheRestIsNoCalmer) {
  MadeUpRest rest;
  rest.left = {{1, 1, 0, 0, 0, 0, 1, 1, 4, 4, 1, 1, 1, 1}, kFirst};
  without_stretches(with_windows(kFirst, kUnexplained), rest);
  EXPECT_THAT(made_up_rest.asked, SizeIs(1));
}

TEST(WithoutUnlikeStretches, TheyAreToldByTheirTime) {
  const auto found =
      without_stretches(with_windows({1, 1, 1, 1, 4, 4, 1, 1, 1, 1, 1, 1}, kUnexplained));
  ASSERT_TRUE(found && found->unexplained);
  EXPECT_EQ(found->unexplained->coordinate, "time in a: 0.75 to 1.75 s");
  EXPECT_NEAR(found->unexplained->share, 2.0 / 3, 1e-9);
  EXPECT_NEAR(found->unexplained->rms_N, 0.6, 1e-9);
  EXPECT_THAT(found->verdicts, ElementsAre("unexplained_structure"));
  ASSERT_THAT(found->findings, SizeIs(1));
  EXPECT_EQ(found->findings.front().name, "stretch_left_out");
}

TEST(WithoutUnlikeStretches, TheyLackTwiceAsMuchAsTheRest) {
  const Diagnosis all = with_windows({1, 1, 1, 1, 4, 4, 1, 1, 1, 1, 1, 1}, kUnexplained);
  MadeUpRest rest;
  rest.unlike = 2.1;
  EXPECT_TRUE(without_stretches(all, rest));
  rest.unlike = 1.9;
  EXPECT_FALSE(without_stretches(all, rest));
}

TEST(WithoutUnlikeStretches, ARestWithoutACauseIsExplained) {
  MadeUpRest rest;
  rest.unlike = 50;
  rest.is_unexplained = true;
  EXPECT_FALSE(
      without_stretches(with_windows({1, 1, 1, 1, 4, 4, 1, 1, 1, 1, 1, 1}, kUnexplained), rest));
}

TEST(WithoutUnlikeStretches, WhereNothingIsUnexplainedOneIsTenTimesTheMedian) {
  EXPECT_TRUE(
      without_stretches(with_windows({1, 1, 1, 1, 10.1, 10.1, 1, 1, 1, 1, 1, 1}, !kUnexplained)));
  EXPECT_FALSE(
      without_stretches(with_windows({1, 1, 1, 1, 9.9, 9.9, 1, 1, 1, 1, 1, 1}, !kUnexplained)));
}

TEST(WithoutUnlikeStretches, WhatGoesWithTheMotionIsNoHands) {
  Diagnosis all = with_windows({1, 1, 1, 1, 4, 4, 1, 1, 1, 1, 1, 1}, kUnexplained);
  all.unexplained->coordinate = "position and speed";
  all.unexplained->share = 0.41;
  EXPECT_FALSE(without_stretches(all));
  all.unexplained->share = 0.39;
  EXPECT_TRUE(without_stretches(all));
  all.unexplained->share = 0.9;
  for (const char* of_none : {"time", kOwnPast, kWholeMotion}) {
    all.unexplained->coordinate = of_none;
    EXPECT_TRUE(without_stretches(all)) << of_none;
  }
}

TEST(WithoutUnlikeStretches, DataThatAreRefusedStayRefused) {
  Diagnosis refused = with_windows({1, 1, 1, 1, 40, 40, 1, 1, 1, 1, 1, 1}, kUnexplained);
  refused.findings.push_back({logs::Finding::Kind::kFatal, "too_short", ""});
  EXPECT_FALSE(without_stretches(refused));
}

}  // namespace
}  // namespace towbench::study::diagnose
