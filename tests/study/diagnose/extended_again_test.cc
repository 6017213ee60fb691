// The extended plant explains the log that it was made from: diagnosed with it, nothing is lacking.
#include <string>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/study/diagnose/brought_case.h"

namespace towbench::tests {
namespace {

using ::testing::HasSubstr;

class ExtendedAgain : public testing::TestWithParam<const char*> {};

TEST_P(ExtendedAgain, NothingIsLacking) {
  HiddenAxis axis;
  axis.effect = GetParam();
  axis.duration_s = 20;
  const BroughtCase brought(axis);
  brought.write("log.csv", csv_of(axis, make_hidden_log(axis, 1)));
  const auto first = brought.diagnose("--data log.csv");
  EXPECT_EQ(names_in(brought.answer()), axis.effect) << first.text;
  const auto again =
      brought.diagnose_without_model("--data log.csv --model found/extended_plant.toml");
  EXPECT_EQ(again.code, 0);
  EXPECT_EQ(names_in(brought.answer()), "") << again.text;
  EXPECT_THAT(again.text, HasSubstr("What is wrong: nothing"));
}

INSTANTIATE_TEST_SUITE_P(Effects, ExtendedAgain,
                         testing::Values("viscous_asymmetry", "cable_spring"),
                         [](const auto& effect) { return std::string(effect.param); });

}  // namespace
}  // namespace towbench::tests
