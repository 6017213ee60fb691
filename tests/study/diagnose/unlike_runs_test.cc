// When the answer of some runs is taken for that of all, by answers that are made up.
#include "study/diagnose/unlike_runs.h"

#include <algorithm>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace towbench::study::diagnose {
namespace {

using ::testing::ElementsAre;
using ::testing::IsEmpty;

// What the others answer, however many are asked.
struct MadeUp {
  double unlike = 3;  // times what they lack, of each run put aside
  bool names_a_cause = false;
  bool is_unexplained = false;
  bool is_free_shape = false;
  double least_gain = 0.1;                  // of the cause
  double standard_errors = 3;               // of that gain
  double gain = 0.3;                        // of all that is named
  bool names_it_without_two = false;        // a cause, only if two runs are put aside
  std::vector<double> innovations_m{1, 1};  // that they leave, of each run
  std::vector<std::size_t> asked{};         // how many runs were put aside, each time
  std::vector<std::string> runs_asked{};    // the first of them
};
MadeUp made_up;

const Effect* effect_that(bool is_free_shape) {
  return &*std::find_if(effects().begin(), effects().end(),
                        [&](const Effect& effect) { return effect.flexible == is_free_shape; });
}

Diagnosis answer(bool names_a_cause, bool is_unexplained) {
  Diagnosis d;
  if (names_a_cause) {
    NamedCause& cause = d.causes.emplace_back();
    cause.effect = effect_that(made_up.is_free_shape);
    cause.gain99.low = made_up.least_gain;
    cause.standard_errors = made_up.standard_errors;
  }
  if (is_unexplained) d.unexplained.emplace();
  d.verdicts.emplace_back(is_unexplained ? "unexplained_structure" : "model_adequate");
  return d;
}

Diagnosis of_others(const Request& request) {
  made_up.asked.push_back(request.aside.size());
  made_up.runs_asked.push_back(request.aside.front().name);
  const bool two = made_up.names_it_without_two && request.aside.size() == 2;
  Diagnosis d = answer(made_up.names_a_cause || two, made_up.is_unexplained);
  d.innovations_of_run_m = made_up.innovations_m;
  d.scored.gain95.value = made_up.gain;
  d.aside.others_rms_N = 0.2;
  d.aside.rms_N.assign(request.aside.size(), made_up.unlike * 0.2);
  return d;
}

std::optional<Diagnosis> without(const Diagnosis& all) {
  Request request;
  for (std::size_t run = 0; run < all.innovations_of_run_m.size(); ++run) {
    request.runs.emplace_back().name = std::string(1, static_cast<char>('a' + run));
  }
  return without_unlike_runs(request, all, of_others);
}

std::vector<std::size_t> left_out(const MadeUp& others, const Diagnosis& all) {
  made_up = others;
  const auto found = without(all);
  return found ? found->left_out : std::vector<std::size_t>{};
}

Diagnosis unexplained(std::vector<double> innovations_m, bool names_a_cause = false) {
  Diagnosis d = answer(names_a_cause, true);
  d.innovations_of_run_m = std::move(innovations_m);
  return d;
}

TEST(WithoutUnlikeRuns, TheWorstIsLeftOutIfItLacksTwiceAsMuch) {
  EXPECT_THAT(left_out({.unlike = 2.1}, unexplained({1, 1, 4})), ElementsAre(2));
  EXPECT_THAT(left_out({.unlike = 1.9}, unexplained({1, 1, 4})), IsEmpty());
}

TEST(WithoutUnlikeRuns, WhatMovesItIsToldByItsName) {
  made_up = {};
  const auto found = without(unexplained({1, 5, 1}));
  ASSERT_TRUE(found && found->unexplained);
  EXPECT_EQ(found->unexplained->coordinate, "time in b");
  EXPECT_NEAR(found->unexplained->share, 2.0 / 3, 1e-9);
  EXPECT_NEAR(found->unexplained->rms_N, 0.6, 1e-9);
  EXPECT_THAT(found->verdicts, ElementsAre("unexplained_structure"));
  ASSERT_EQ(found->findings.size(), 1U);
  EXPECT_EQ(found->findings.front().name, "run_left_out");
}

TEST(WithoutUnlikeRuns, WhatIsLeftInTheOthersIsToldFirst) {
  made_up = {.unlike = 9, .names_a_cause = true, .is_unexplained = true};
  const auto found = without(unexplained({1, 5, 1}));
  ASSERT_TRUE(found && found->unexplained);
  EXPECT_EQ(found->unexplained->coordinate, "");
  EXPECT_THAT(found->verdicts, ElementsAre("unexplained_structure"));
  EXPECT_EQ(found->findings.size(), 1U);
}

TEST(WithoutUnlikeRuns, HalfOfThemStay) {
  EXPECT_THAT(left_out({.unlike = 1}, unexplained({1, 1, 4})), IsEmpty());
  EXPECT_THAT(made_up.asked, ElementsAre(1));
  EXPECT_THAT(left_out({.unlike = 1}, unexplained({1, 1, 4, 3, 1, 2})), IsEmpty());
  EXPECT_THAT(made_up.asked, ElementsAre(1, 2));
  EXPECT_THAT(left_out({}, unexplained({1})), IsEmpty());
  EXPECT_THAT(made_up.asked, IsEmpty());
}

TEST(WithoutUnlikeRuns, OthersThatAreNotExplainedNeedACauseAndFiveTimes) {
  const MadeUp cause{.unlike = 5.1, .names_a_cause = true, .is_unexplained = true};
  EXPECT_THAT(left_out(cause, unexplained({1, 4})), ElementsAre(1));
  EXPECT_THAT(
      left_out({.unlike = 4.9, .names_a_cause = true, .is_unexplained = true}, unexplained({1, 4})),
      IsEmpty());
  EXPECT_THAT(left_out({.unlike = 50, .is_unexplained = true}, unexplained({1, 4})), IsEmpty());
}

TEST(WithoutUnlikeRuns, ACauseIsNotExchangedForNone) {
  made_up = {};
  EXPECT_THAT(left_out({.unlike = 50}, unexplained({1, 4}, true)), IsEmpty());
  EXPECT_THAT(left_out({.names_a_cause = true}, unexplained({1, 4}, true)), ElementsAre(1));
}

TEST(WithoutUnlikeRuns, AFreeShapeThatMayGainNothingIsExchangedForNone) {
  made_up = {.is_free_shape = true, .least_gain = -0.01};
  const Diagnosis shape = unexplained({1, 4}, true);
  EXPECT_THAT(left_out({.unlike = 50}, shape), ElementsAre(1));
  EXPECT_THAT(left_out({.unlike = 50, .is_unexplained = true}, shape), IsEmpty());
  made_up = {.least_gain = -0.01};
  const Diagnosis law = unexplained({1, 4}, true);
  EXPECT_THAT(left_out({.unlike = 50}, law), IsEmpty());
}

TEST(WithoutUnlikeRuns, AFreeShapeIsNotBelieved) {
  EXPECT_THAT(
      left_out({.unlike = 50, .names_a_cause = true, .is_free_shape = true}, unexplained({1, 4})),
      IsEmpty());
}

TEST(WithoutUnlikeRuns, AFreeShapeIsBelievedWhereItLeavesLittle) {
  const auto gains = [](double gain) {
    return MadeUp{.names_a_cause = true, .is_free_shape = true, .gain = gain};
  };
  EXPECT_THAT(left_out(gains(0.86), unexplained({1, 4})), ElementsAre(1));
  EXPECT_THAT(left_out(gains(0.84), unexplained({1, 4})), IsEmpty());
}

// A fit that the second has led astray.
TEST(WithoutUnlikeRuns, TheWorstOfTheStatedModelIsTriedNext) {
  Diagnosis all = unexplained({4, 1, 1}, true);
  all.stated_of_run_m = {2, 5, 2};
  EXPECT_THAT(left_out({.unlike = 1, .names_a_cause = true}, all), IsEmpty());
  EXPECT_THAT(made_up.runs_asked, ElementsAre("a", "b"));
  all.stated_of_run_m = {6, 5, 2};
  EXPECT_THAT(left_out({.unlike = 1, .names_a_cause = true}, all), IsEmpty());
  EXPECT_THAT(made_up.runs_asked, ElementsAre("a"));
}

// Another push hides a cause: c is left out, and a, b, d, e stay.
TEST(WithoutUnlikeRuns, AnotherIsLeftOutWhereTheRestNamesNothingAndItIsApart) {
  const Diagnosis all = unexplained({1, 1, 4, 1, 2});
  const MadeUp names{.names_it_without_two = true, .innovations_m = {1, 1, 1, 1.6}};
  EXPECT_THAT(left_out(names, all), ElementsAre(2, 4));
  EXPECT_THAT(left_out({.innovations_m = {1, 1, 1, 1.6}}, all), ElementsAre(2)) << "no cause";
  EXPECT_THAT(left_out({.names_it_without_two = true, .innovations_m = {1, 1, 1, 1.4}}, all),
              ElementsAre(2));
  EXPECT_THAT(
      left_out({.names_it_without_two = true, .innovations_m = {1, 1.6}}, unexplained({1, 4, 1})),
      ElementsAre(1))
      << "half of them stay";
  EXPECT_THAT(left_out({.names_it_without_two = true, .innovations_m = {1, 1.6, 1, 1}}, all),
              ElementsAre(2, 1));
}

TEST(WithoutUnlikeRuns, ACauseThatMayGainNothingIsNotBelieved) {
  const Diagnosis all = unexplained({1, 4});
  EXPECT_THAT(left_out({.names_a_cause = true, .standard_errors = 2.5}, all), IsEmpty());
  EXPECT_THAT(left_out({.names_a_cause = true, .standard_errors = 2.7}, all), ElementsAre(1));
}

TEST(WithoutUnlikeRuns, ARunFarOffIsEnoughThoughNothingIsUnexplained) {
  Diagnosis adequate = answer(false, false);
  adequate.innovations_of_run_m = {1, 10.1, 0.9};
  EXPECT_THAT(left_out({}, adequate), ElementsAre(1));
  adequate.innovations_of_run_m = {1, 9.9, 0.9};
  EXPECT_THAT(left_out({}, adequate), IsEmpty());
}

// A law is missing in all of them alike: no run is asked for.
TEST(WithoutUnlikeRuns, WhatFollowsTheMotionNeedsARunThatIsApart) {
  Diagnosis all = unexplained({1, 1.4, 0.9});
  all.unexplained->coordinate = "speed";
  all.unexplained->share = 0.41;
  EXPECT_THAT(left_out({}, all), IsEmpty());
  EXPECT_THAT(made_up.asked, IsEmpty());
  all.unexplained->share = 0.39;
  EXPECT_THAT(left_out({}, all), ElementsAre(1));
  all.unexplained->share = 0.41;
  all.innovations_of_run_m = {1, 1.6, 0.9};
  EXPECT_THAT(left_out({}, all), ElementsAre(1));
}

// It takes on what moves the axis in one run.
TEST(WithoutUnlikeRuns, AForceOfTimeIsEnoughThoughNothingIsUnexplained) {
  Diagnosis all = answer(true, false);
  all.innovations_of_run_m = {1, 2};
  EXPECT_THAT(left_out({.names_a_cause = true}, all), IsEmpty());
  all.causes.front().effect = find_effect("periodic_force");
  EXPECT_THAT(left_out({.names_a_cause = true}, all), ElementsAre(1));
}

TEST(WithoutUnlikeRuns, DataThatAreRefusedStayRefused) {
  Diagnosis refused = unexplained({1, 40});
  refused.findings.push_back({logs::Finding::Kind::kFatal, "too_short", ""});
  EXPECT_THAT(left_out({}, refused), IsEmpty());
}

}  // namespace
}  // namespace towbench::study::diagnose
