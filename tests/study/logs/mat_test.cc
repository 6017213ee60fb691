// MATLAB files written by another program (data/make_mat.m), and files that are damaged.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "study/logs/read_table.h"
#include "tests/harness/fixtures/temporary_fixtures.h"
#include "tests/study/logs/log_files.h"

namespace towbench::tests {
namespace {

using namespace study::logs;
using testing::ElementsAre;
using testing::HasSubstr;

class OctavesFile : public testing::TestWithParam<const char*> {};

TEST_P(OctavesFile, GivesEverySeriesOfTheCommonLength) {
  Findings findings;
  const Table table = read_table(kLogFiles / GetParam(), findings);
  ASSERT_FALSE(is_fatal(findings));
  EXPECT_THAT(table.names, ElementsAre("t", "q", "single_current", "counts", "both_1", "both_2",
                                       "log.volts", "log.inner.flag"));
  ASSERT_EQ(table.rows(), 200U);
  for (std::size_t i = 0; i < 200; ++i) {
    const double n = static_cast<double>(i);
    const double q = 0.125 * n;
    EXPECT_EQ((*table.find("t"))[i], n / 1000);
    EXPECT_EQ((*table.find("q"))[i], q);
    EXPECT_EQ((*table.find("single_current"))[i], q / 4);
    EXPECT_EQ((*table.find("counts"))[i], n);
    EXPECT_EQ((*table.find("both_2"))[i], -q);
    EXPECT_EQ((*table.find("log.volts"))[i], 2 * q);
    EXPECT_EQ((*table.find("log.inner.flag"))[i], q > 5 ? 1 : 0);
  }
}

TEST_P(OctavesFile, SaysWhatIsNoSeries) {
  Findings findings;
  (void)read_table(kLogFiles / GetParam(), findings);
  const Finding* note = named(findings, "mat_left_out");
  ASSERT_NE(note, nullptr);
  for (const char* what :
       {"gain is a single number", "words holds no numbers", "short has 3 numbers, not 200",
        "complex_one holds no real numbers", "cells holds no numbers"}) {
    EXPECT_THAT(note->sentence, HasSubstr(what));
  }
}

// Whatever byte is damaged, the caller goes on: with the file, or with one line.
TEST_P(OctavesFile, DamagedIsReadOrRefusedInOneLine) {
  const std::string whole = bytes_of(kLogFiles / GetParam());
  const harness::TemporaryFixtures folder;
  for (std::size_t at = 128; at < whole.size(); at += whole.size() / 24) {
    std::string damaged = whole;
    damaged[at] = static_cast<char>(~damaged[at]);
    const auto path = folder.write("damaged.mat", damaged);
    Findings findings;
    const Table table = read_table(path, findings);
    for (const Finding& finding : findings) {
      EXPECT_THAT(finding.sentence, HasSubstr(path.string()));
    }
    for (const auto& column : table.columns) {
      EXPECT_EQ(column.size(), table.rows());
    }
  }
}

INSTANTIATE_TEST_SUITE_P(Formats, OctavesFile, testing::Values("plain.mat", "compressed.mat"),
                         [](const auto& given) { return stem_of(given.param); });

TEST(MatLog, ThatIsNothingButAHeadIsRefused) {
  const harness::TemporaryFixtures folder;
  Findings findings;
  (void)read_table(folder.write("head.mat", "MATLAB 5.0 MAT-file, and no more"), findings);
  EXPECT_TRUE(named(findings, "mat_unreadable") != nullptr ||
              named(findings, "header_unusable") != nullptr);
  EXPECT_TRUE(is_fatal(findings));
}

}  // namespace
}  // namespace towbench::tests
