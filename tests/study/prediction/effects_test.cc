// The registry of causes: what every entry must say of itself.
#include <algorithm>
#include <set>

#include <gtest/gtest.h>

#include "study/prediction/effect.h"

namespace towbench::tests {
namespace {

using namespace study::diagnose;

TEST(Effects, SayTheirLawItsSourceAndWhatWouldShowThem) {
  for (const Effect& effect : effects()) {
    SCOPED_TRACE(effect.name);
    EXPECT_FALSE(effect.law.empty());
    EXPECT_FALSE(effect.source.empty());
    EXPECT_FALSE(effect.cause.empty());
    EXPECT_FALSE(effect.needs.empty());
  }
}

TEST(Effects, HaveAUnitForEachNumberThatTheyAreFittedBy) {
  for (const Effect& effect : effects()) {
    SCOPED_TRACE(effect.name);
    EXPECT_EQ(effect.amplitude_names.size(), effect.amplitudes.size());
    EXPECT_EQ(effect.scale_names.size(), effect.scales.size());
    EXPECT_FALSE(effect.amplitudes.empty() && effect.scales.empty());
    std::set<std::string> names(effect.amplitude_names.begin(), effect.amplitude_names.end());
    names.insert(effect.scale_names.begin(), effect.scale_names.end());
    EXPECT_EQ(names.size(), effect.amplitudes.size() + effect.scales.size());
  }
}

TEST(Effects, HaveKeysOfThePlantFileWithTheirValuesOrNeither) {
  int expressed = 0;
  for (const Effect& effect : effects()) {
    EXPECT_EQ(effect.plant_keys.empty(), effect.plant_values == nullptr) << effect.name;
    expressed += effect.plant_keys.empty() ? 0 : 1;
  }
  EXPECT_GT(expressed, 20);
}

}  // namespace
}  // namespace towbench::tests
