// The map of a foreign log's columns: what it says is taken, and what is wrong is told by its line.
#include "study/logs/column_map.h"

#include <filesystem>
#include <fstream>
#include <string>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <unistd.h>

namespace towbench::tests {
namespace {

using namespace study::logs;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using ::testing::SizeIs;

constexpr const char* kNeeded = "position = 'q1'\ninput = 'tau1'\n";

class ColumnMaps : public testing::Test {
 protected:
  ColumnMap read(const std::string& text) {
    std::ofstream(path_) << text;
    return read_column_map(path_, findings_);
  }
  void TearDown() override { std::filesystem::remove(path_); }

  Findings findings_;

 private:
  std::filesystem::path path_ =
      std::filesystem::temp_directory_path() / ("column-map-" + std::to_string(getpid()) + ".toml");
};

TEST_F(ColumnMaps, NamesATemperatureAndOtherAxes) {
  const ColumnMap map = read(kNeeded + std::string("temperature = 't_C'\n"
                                                   "[[other]]\nposition = 'q2'\nrotary = true\n"
                                                   "[[other]]\nposition = 'rail'\n"
                                                   "position_scale_m = 1e-3\n"));
  EXPECT_THAT(findings_, IsEmpty());
  EXPECT_EQ(map.temperature, "t_C");
  ASSERT_THAT(map.others, SizeIs(2));
  EXPECT_EQ(map.others[0].position, "q2");
  EXPECT_TRUE(map.others[0].rotary);
  EXPECT_EQ(map.others[0].position_scale_m, 1);
  EXPECT_EQ(map.others[1].position, "rail");
  EXPECT_FALSE(map.others[1].rotary);
  EXPECT_EQ(map.others[1].position_scale_m, 1e-3);
}

TEST_F(ColumnMaps, OfMoreOtherAxesThanFiveAreRefused) {
  std::string text = kNeeded;
  for (int i = 0; i < 6; ++i) text += "[[other]]\nposition = 'q'\n";
  read(text);
  ASSERT_THAT(findings_, SizeIs(1));
  EXPECT_THAT(findings_[0].sentence, HasSubstr(".toml:3: 'other' is no key of a column map"));
  EXPECT_THAT(findings_[0].sentence, HasSubstr("at most 5"));
}

class WrongMaps : public ColumnMaps, public testing::WithParamInterface<const char*> {};

TEST_P(WrongMaps, AreRefusedWithTheLine) {
  read(kNeeded + std::string(GetParam()));
  ASSERT_THAT(findings_, SizeIs(1));
  EXPECT_EQ(findings_[0].kind, Finding::Kind::kFatal);
  EXPECT_EQ(findings_[0].name, "columns_unusable");
  EXPECT_THAT(findings_[0].sentence, HasSubstr(".toml:3: "));
}

INSTANTIATE_TEST_SUITE_P(Lines, WrongMaps,
                         testing::Values("temperature = 3", "other = 'q2'", "other = []",
                                         "other = [3]", "[[other]]", "[[other]]\npostion = 'q2'",
                                         "[[other]]\nposition = 2",
                                         "[[other]]\nposition = 'q2'\nposition_scale_m = 0",
                                         "[[other]]\nposition = 'q2'\nrotary = 'yes'",
                                         "other_position = 'q2'"));

}  // namespace
}  // namespace towbench::tests
