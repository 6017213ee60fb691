// Logs of the bench's own rig, elastic transmission and all, made by the emulator under BBMC.
#include <algorithm>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/study/diagnose/bench_case.h"
#include "tests/study/diagnose/hidden_case.h"

namespace towbench::tests {
namespace {

bool holds(const std::vector<std::string>& names, const std::string& name) {
  return std::find(names.begin(), names.end(), name) != names.end();
}

TEST(BenchLog, OfTheMachineAsStatedNamesNothing) {
  const auto d = diagnose_bench({.effect = "", .strength = 1, .seed = 1});
  EXPECT_THAT(named(d), testing::IsEmpty());
  EXPECT_THAT(d.verdicts, testing::ElementsAre("model_adequate"));
}

class BenchEffect : public testing::TestWithParam<std::string> {};

TEST_P(BenchEffect, HiddenInTheEmulatorIsNamedAndNothingElse) {
  const std::string effect = GetParam();
  const auto all = named(diagnose_bench({.effect = effect, .strength = 1, .seed = 1}));
  EXPECT_TRUE(
      std::any_of(all.begin(), all.end(), [&](const auto& names) { return holds(names, effect); }));
  for (const auto& names : all) {
    EXPECT_TRUE(holds(names, effect)) << "named beside it: " << names.front();
  }
}

INSTANTIATE_TEST_SUITE_P(All, BenchEffect, testing::ValuesIn(bench_effects(true)),
                         [](const auto& parameter) { return parameter.param; });

}  // namespace
}  // namespace towbench::tests
