// What the answer says of the plant file that was written.
#include "study/diagnose/headline.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace towbench::tests {
namespace {

using namespace study::diagnose;
using testing::HasSubstr;
using testing::Not;

// Play was named; the emulator ends so far off, in metres.
Diagnosis found(double supplied_m, double extended_m) {
  Diagnosis d;
  d.verdicts = {"cause_found"};
  d.causes.push_back(
      {.effect = find_effect("backlash"), .sizes = {}, .p_value = 1e-9, .gain99 = {0.3, 0.2, 0.4}});
  d.emulated = Emulated{};
  d.emulated->windows.count = 40;
  d.emulated->windows.supplied_m = supplied_m;
  d.emulated->windows.extended_m = extended_m;
  return d;
}

TEST(Headline, SaysHowFarTheEmulatorIsFromTheLogWithEitherPlant) {
  const std::string text = headline(found(4e-3, 1e-3));
  EXPECT_THAT(text, HasSubstr("in the emulator under the measured input alone for 0.5 s, it ends 1 "
                              "instead of 4 mm off"));
  EXPECT_THAT(text, HasSubstr("What to do:    use extended_plant.toml."));
  EXPECT_THAT(text, Not(HasSubstr("  extended_plant.toml")));
}

TEST(Headline, KeepsTheSuppliedPlantWhereTheEmulatorEndsNoNearer) {
  const std::string text = headline(found(1e-3, 1e-3));
  EXPECT_THAT(text, HasSubstr("What to do:    keep the supplied plant."));
  EXPECT_THAT(text, HasSubstr("  extended_plant.toml      in the emulator ends no nearer"));
}

// Causes that took on a push in one run.
TEST(Headline, SaysWhatARunSpeaksAgainst) {
  Diagnosis d;
  d.refuted = {"cable_spring", "stiction"};
  d.unexplained = Unexplained{.coordinate = kWholeMotion, .share = 0.4, .rms_N = 1};
  d.verdicts = {"unexplained_structure"};
  const std::string text = headline(d);
  EXPECT_THAT(text, HasSubstr("cable_spring with stiction predicts some runs better and another "
                              "surely worse"));
  EXPECT_THAT(text, HasSubstr("What to do:    find out in what the runs differ"));
}

TEST(Headline, SaysThatAHeldOutRunHasMuchOfItsOwn) {
  Diagnosis d = found(4e-3, 1e-3);
  d.scored.same_session = false;
  d.scored.gain95 = {-1.6, -2.2, -0.1};
  EXPECT_THAT(headline(d), HasSubstr("; held-out runs are predicted worse, but not surely"));
  EXPECT_THAT(headline(d),
              HasSubstr("find out in what the held-out runs differ before it is used"));
  d.scored.gain95.high = 0.1;
  EXPECT_THAT(headline(d), Not(HasSubstr("before it is used")));
  EXPECT_THAT(headline(d), HasSubstr("; scored on held-out runs."));
}

TEST(Headline, SendsToTheSizesWhereTheEmulatorCannotHaveThem) {
  Diagnosis d = found(1e-3, 1e-3);
  d.emulated->left_out = {"cross_axis_coupling"};
  EXPECT_THAT(headline(d), HasSubstr("What to do:    use the sizes in diagnosis.json; the emulator "
                                     "lacks them."));
}

TEST(Headline, NamesWhatTheFileLacksWhateverIsToBeDoneNext) {
  Diagnosis d = found(4e-3, 1e-3);
  d.causes.front().alternatives = {"presliding"};
  d.emulated->left_out = {"transport_delay"};
  const std::string text = headline(d);
  EXPECT_THAT(text, HasSubstr("What to do:    no motion in reach tells"));
  EXPECT_THAT(text, HasSubstr("  extended_plant.toml      lacks transport_delay: "));
}

TEST(Headline, SaysWhatIsLeftDependsOnWhereThatHasNoBins) {
  Diagnosis d;
  d.verdicts = {"unexplained_structure"};
  d.unexplained = Unexplained{.coordinate = "the motion before", .share = 0.3};
  EXPECT_THAT(headline(d), HasSubstr("what is left depends on the motion before, by no known law"));
  d.unexplained->coordinate = kOwnPast;
  EXPECT_THAT(headline(d), HasSubstr("no coordinate of the motion explains it"));
}

TEST(Headline, SendsToTheNumbersWhereNoPlantFileWasWritten) {
  Diagnosis d = found(4e-3, 1e-3);
  d.emulated.reset();
  EXPECT_THAT(headline(d), Not(HasSubstr("extended_plant.toml")));
}

}  // namespace
}  // namespace towbench::tests
