// What a slow logger keeps: whole rows of log.csv, the first behind each of its moments.
#include "harness/record/logger_file.h"

#include <fstream>
#include <sstream>
#include <string>

#include <gtest/gtest.h>

#include "tests/harness/fixtures/temporary_fixtures.h"

namespace towbench::harness {
namespace {

std::string kept_of(const std::string& log, double rate_Hz) {
  const TemporaryFixtures files;
  files.write("log.csv", log);
  write_logger_file(files.folder(), rate_Hz);
  std::ifstream stream(files.folder() / "logger.csv");
  std::ostringstream text;
  text << stream.rdbuf();
  return text.str();
}

// Rows of 1 ms, each with its number.
std::string log_of(int rows) {
  std::ostringstream text;
  text << "time_s,y_count\n";
  for (int i = 0; i < rows; ++i) {
    text << 1e-3 * i << ',' << i << '\n';
  }
  return text.str();
}

TEST(LoggerFile, KeepsTheFirstRowBehindEachOfItsMoments) {
  std::string wanted = "time_s,y_count\n0,0\n";  // 150 Hz: 6.67, 13.33, 20 ms
  for (const int row : {7, 14, 20, 27, 34, 40}) {
    std::ostringstream line;
    line << 1e-3 * row << ',' << row << '\n';
    wanted += line.str();
  }
  EXPECT_EQ(kept_of(log_of(47), 150.0), wanted);
}

TEST(LoggerFile, KeepsEveryRowAtTheControllersRate) {
  EXPECT_EQ(kept_of(log_of(3000), 1000.0), log_of(3000));
  EXPECT_EQ(kept_of(log_of(50), 10e3), log_of(50));
}

TEST(LoggerFile, IsNotThereWithoutARate) {
  EXPECT_EQ(kept_of(log_of(10), 0.0), "");
}

}  // namespace
}  // namespace towbench::harness
