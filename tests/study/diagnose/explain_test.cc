// Why an effect was named, or not.
#include "study/diagnose/explain.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/study/diagnose/brought_case.h"

namespace towbench::tests {
namespace {

using namespace study::diagnose;
using testing::HasSubstr;
using testing::StartsWith;

TEST(Explain, SaysForEachFateOfAnEffectWhatDecided) {
  Diagnosis d;
  d.tried = 60;
  d.causes.push_back({.effect = find_effect("stribeck"),
                      .sizes = {{"excess_N", {2, 1.8, 2.2}, false}},
                      .p_value = 1e-9,
                      .gain99 = {0.3, 0.2, 0.4},
                      .alternatives = {"stiction"}});
  d.not_testable.push_back({"backlash", "only 1 % of it is its own", "reversals"});
  d.dropped = {"cable_spring"};
  d.not_testable.push_back({"cable_spring", "none of it is left", "two speeds"});
  d.refuted = {"position_force"};
  d.considered = {{"presliding", 0.2, {0.05, 0, 0.1}, 4, true},
                  {"torque_ripple", 1e-5, {0.005, 0.001, 0.009}, 3, true},
                  {"chain_polygon", 1e-5, {0.2, 0.1, 0.3}, 2, true},
                  {"quadratic_drag", 1e-9, {0.2, 0.1, 0.3}, 5, false},
                  {"cubic_viscous", 1e-9, {0.2, 0.1, 0.3}, 5, true}};
  EXPECT_THAT(explain(d, "stribeck"),
              StartsWith("stribeck: named: p 1.0e-09, its own gain 30.0 % (99 %: 20.0 to 40.0), "
                         "excess_N 2 [1.8, 2.2]"));
  EXPECT_THAT(explain(d, "stiction"), HasSubstr("not told from stribeck"));
  EXPECT_THAT(explain(d, "backlash"), HasSubstr("only 1 % of it is its own; it takes reversals"));
  EXPECT_THAT(explain(d, "cable_spring"), HasSubstr("dropped again"));
  EXPECT_THAT(explain(d, "presliding"), HasSubstr("p below 0.001 is needed"));
  EXPECT_THAT(explain(d, "torque_ripple"), HasSubstr("more than 1 % and 2.5 standard errors"));
  EXPECT_THAT(explain(d, "chain_polygon"), HasSubstr("2.0 standard errors above nothing"));
  EXPECT_THAT(explain(d, "quadratic_drag"), HasSubstr("law does not allow"));
  EXPECT_THAT(explain(d, "cubic_viscous"), HasSubstr("no better than what is named"));
  d.parameters = {{"inertia", 8, {9, 8.9, 9.1}, "kg", true, {}},
                  {"viscous", 5, {5.1, 4.9, 5.3}, "N s/m", false, {}}};
  EXPECT_EQ(explain(d, "inertia"), "inertia: off: 9 kg [8.9, 9.1] by the log, 8 by the model.\n");
  EXPECT_THAT(explain(d, "viscous"), HasSubstr("not named: 5.1 N s/m [4.9, 5.3] by the log, 5 by "
                                               "the model; more than 4 standard errors"));
  EXPECT_THAT(explain(d, "position_force"), HasSubstr("another surely against"));
  EXPECT_THAT(explain(d, "gravity"), HasSubstr("not tried beside what is named"));
  d.causes.clear();
  EXPECT_THAT(explain(d, "gravity"), HasSubstr("not tried on this data"));
}

TEST(Explain, IsPrintedBehindTheHeadlineForEveryEffectThatIsAskedFor) {
  const HiddenAxis axis;
  const BroughtCase brought(axis);
  brought.write("log.csv", csv_of(axis, make_hidden_log(axis, 12)));
  const auto told = brought.diagnose(
      "--data log.csv --explain quadratic_drag --explain gravity --explain coulomb");
  EXPECT_EQ(told.code, 0);
  EXPECT_THAT(told.text, HasSubstr("\nquadratic_drag: not "));
  EXPECT_THAT(told.text, HasSubstr("\ngravity: not to be seen in this data"));
  EXPECT_THAT(told.text, HasSubstr("\ncoulomb: not named: 1.58"));
  const auto unknown = brought.diagnose("--data log.csv --explain moonlight");
  EXPECT_EQ(unknown.code, 2);
  EXPECT_THAT(unknown.text, HasSubstr("no cause 'moonlight'; --causes lists them"));
  const auto misspelt = brought.diagnose("--data log.csv --explain backlsh");
  EXPECT_EQ(misspelt.code, 2);
  EXPECT_THAT(misspelt.text, HasSubstr("no cause 'backlsh'; did you mean backlash?"));
}

TEST(Explain, ListsWhatCanBeNamedWithoutALog) {
  const auto told = BroughtCase().diagnose("--causes");
  EXPECT_EQ(told.code, 0);
  for (const Effect& effect : effects()) {
    if (effect.other > 0) continue;  // as the first of the other axes
    EXPECT_THAT(told.text, HasSubstr("\n" + effect.name + ": " + effect.cause + "\n"));
    EXPECT_THAT(told.text, HasSubstr(effect.law));
    for (const std::string& key : effect.plant_keys) EXPECT_THAT(told.text, HasSubstr(key));
  }
}

}  // namespace
}  // namespace towbench::tests
