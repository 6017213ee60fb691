// MCAP files written with MCAP's own library (data/make_mcap.mjs), and files that are damaged.
#include <cmath>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "study/logs/read_table.h"
#include "tests/harness/fixtures/temporary_fixtures.h"
#include "tests/study/logs/log_files.h"

namespace towbench::tests {
namespace {

using namespace study::logs;
using testing::HasSubstr;
using testing::UnorderedElementsAre;

Table table_of(const std::string& bytes, Findings& findings) {
  const harness::TemporaryFixtures folder;
  return read_table(folder.write("log.mcap", bytes), findings);
}

class LibrarysFile : public testing::TestWithParam<const char*> {};

TEST_P(LibrarysFile, JoinsItsTopicsAtTheRowsOfTheBusiestOne) {
  Findings findings;
  const Table table = read_table(kLogFiles / GetParam(), findings);
  ASSERT_FALSE(is_fatal(findings));
  EXPECT_THAT(table.names, UnorderedElementsAre("log_time_s", "axis/state.position.m",
                                                "axis/state.currents.0", "axis/state.currents.1",
                                                "axis/command.volts", "axis/command.enabled"));
  ASSERT_EQ(table.rows(), 200U);
  for (std::size_t i = 0; i < 200; ++i) {
    const double n = static_cast<double>(i);
    EXPECT_NEAR((*table.find("log_time_s"))[i], n / 1000, 1e-12);
    EXPECT_EQ((*table.find("axis/state.position.m"))[i], 0.125 * n);
    EXPECT_EQ((*table.find("axis/state.currents.1"))[i], -n);
    EXPECT_EQ((*table.find("axis/command.volts"))[i], std::floor(n / 2) / 2);  // held
    EXPECT_EQ((*table.find("axis/command.enabled"))[i], 1);
  }
  EXPECT_NE(named(findings, "topics_joined"), nullptr);
  ASSERT_NE(named(findings, "mcap_left_out"), nullptr);
  EXPECT_THAT(named(findings, "mcap_left_out")->sentence, HasSubstr("/camera (protobuf)"));
}

TEST_P(LibrarysFile, CutOffIsReadAsFarAsItGoesAndTold) {
  const std::string whole = bytes_of(kLogFiles / GetParam());
  Findings findings;
  const Table table = table_of(whole.substr(0, whole.size() / 2), findings);
  EXPECT_NE(named(findings, "mcap_damaged"), nullptr);
  EXPECT_LT(table.rows(), 200U);
}

// Whatever byte is damaged, what is read is what was written, or it is told.
TEST_P(LibrarysFile, DamagedIsNeverReadAsSomethingElse) {
  const std::string whole = bytes_of(kLogFiles / GetParam());
  for (std::size_t at = 8; at < whole.size(); at += whole.size() / 97) {
    std::string damaged = whole;
    damaged[at] = static_cast<char>(~damaged[at]);
    Findings findings;
    const Table table = table_of(damaged, findings);
    const auto* place = table.find("axis/state.position.m");
    const bool told = named(findings, "mcap_damaged") != nullptr || is_fatal(findings);
    if (!told && place != nullptr) {
      ASSERT_EQ(table.rows(), 200U) << "byte " << at;
      EXPECT_EQ((*place)[199], 0.125 * 199) << "byte " << at;
    }
  }
}

INSTANTIATE_TEST_SUITE_P(Formats, LibrarysFile,
                         testing::Values("plain.mcap", "zstd.mcap", "lz4.mcap"),
                         [](const auto& given) { return stem_of(given.param); });

TEST(McapLog, WithoutAMessageIsRefused) {
  Findings findings;
  (void)table_of("\x89MCAP0\r\n", findings);
  EXPECT_NE(named(findings, "no_rows"), nullptr);
}

}  // namespace
}  // namespace towbench::tests
