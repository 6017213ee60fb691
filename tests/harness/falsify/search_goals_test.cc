// Which rule the optimiser goes for, and where.
#include "harness/falsify/search_goals.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace towbench::harness {
namespace {

using ::testing::ElementsAre;
using ::testing::IsEmpty;
using Goals = std::vector<SearchGoal>;

// Two experiments with three spaces each.
std::vector<SearchSpace> six_spaces() {
  std::vector<SearchSpace> spaces;
  for (std::size_t i = 0; i < 6; ++i) {
    spaces.push_back(
        {.experiment = i / 3, .faults = FaultSpace(fault_choices({"supply sag"}, {}), 10)});
  }
  return spaces;
}

FalsifyTrial trial(std::size_t space, std::map<std::string, double> rules, bool fired = true) {
  FalsifyTrial one{.space = space};
  one.outcome.fired = fired;
  one.outcome.rules = std::move(rules);
  for (const auto& [rule, margin] : one.outcome.rules) {
    one.outcome.margin = std::min(one.outcome.margin.value_or(margin), margin);
  }
  return one;
}

TEST(SearchGoals, GiveEachRuleItsOwnOrderAndTakeThemInTurn) {
  // Rule b is never as small as a, and would be hidden by the smallest of both.
  const std::vector<FalsifyTrial> trials{
      trial(0, {{"a", 0.1}, {"b", 1.0}}), trial(1, {{"a", 0.02}, {"b", 1.0}}),
      trial(2, {{"a", 0.5}, {"b", 1.0}}), trial(0, {{"a", 0.5}, {"b", 0.3}}),
      trial(1, {{"a", 0.5}, {"b", 1.0}}), trial(2, {{"a", 0.5}, {"b", 0.4}})};
  EXPECT_THAT(
      search_goals(trials, six_spaces()),
      ElementsAre(SearchGoal{1, "a"}, SearchGoal{0, "b"}, SearchGoal{0, "a"}, SearchGoal{2, "b"}));
}

// A motion that ends near a switch is near to it with any fault.
TEST(SearchGoals, CompareAMarginWithTheUsualOneOfItsExperiment) {
  const std::vector<FalsifyTrial> trials{trial(0, {{"a", 0.2}}),  trial(1, {{"a", 0.2}}),
                                         trial(2, {{"a", 0.15}}), trial(3, {{"a", 1.0}}),
                                         trial(4, {{"a", 0.4}}),  trial(5, {{"a", 1.0}})};
  EXPECT_THAT(search_goals(trials, six_spaces()), ElementsAre(SearchGoal{4, "a"}));
}

TEST(SearchGoals, AreNoneWhereNothingFiredOrNothingIsNearer) {
  EXPECT_THAT(search_goals({}, six_spaces()), IsEmpty());
  const std::vector<FalsifyTrial> same{trial(0, {{"a", 1.0}}), trial(1, {{"a", 1.0}}),
                                       trial(2, {{"a", 0.0}}, false)};
  EXPECT_THAT(search_goals(same, six_spaces()), IsEmpty());
}

TEST(SearchGoals, OfOneRequirementAreAllSpacesByTheirMargin) {
  std::vector<FalsifyTrial> trials(3);
  for (std::size_t i = 0; i < 3; ++i) {
    trials[i].space = 2 * i;
    trials[i].outcome = {.fired = true, .margin = 5.0 - 0.1 * static_cast<double>(i)};
  }
  EXPECT_THAT(search_goals(trials, six_spaces()),
              ElementsAre(SearchGoal{4, ""}, SearchGoal{2, ""}, SearchGoal{0, ""}));
}

}  // namespace
}  // namespace towbench::harness
