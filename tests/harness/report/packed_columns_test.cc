#include "harness/report/packed_columns.h"

#include <cmath>
#include <cstdint>
#include <limits>

#include <gtest/gtest.h>

namespace towbench::harness::report {
namespace {

constexpr double kMissing = std::numeric_limits<double>::quiet_NaN();

// Written from RFC 4648 and the description in packed_columns.h, as a reader of the page would.
std::vector<std::uint8_t> bytes_of(const std::string& text) {
  std::vector<std::uint8_t> bytes;
  std::uint32_t buffer = 0;
  int bits = 0;
  for (const char c : text) {
    int value = -1;
    if (c >= 'A' && c <= 'Z') value = c - 'A';
    if (c >= 'a' && c <= 'z') value = c - 'a' + 26;
    if (c >= '0' && c <= '9') value = c - '0' + 52;
    if (c == '+') value = 62;
    if (c == '/') value = 63;
    if (value < 0) break;
    buffer = (buffer << 6U) | static_cast<std::uint32_t>(value);
    bits += 6;
    if (bits >= 8) {
      bits -= 8;
      bytes.push_back(static_cast<std::uint8_t>(buffer >> static_cast<unsigned>(bits)));
    }
  }
  return bytes;
}

std::vector<double> unpacked(const nlohmann::json& column) {
  const std::vector<std::uint8_t> bytes = bytes_of(column["data"].get<std::string>());
  const auto width = column["bits"].get<std::size_t>() / 8;
  std::vector<double> values;
  for (std::size_t at = 0; at < bytes.size(); at += width) {
    double code = 0;
    bool all_set = true;
    for (std::size_t i = width; i-- > 0;) {
      code = code * 256 + bytes[at + i];
      all_set = all_set && bytes[at + i] == 0xFF;
    }
    values.push_back(
        all_set ? kMissing : column["offset"].get<double>() + column["scale"].get<double>() * code);
  }
  return values;
}

void expect_equal(const std::vector<double>& values, double tolerance) {
  const std::vector<double> back = unpacked(packed("c", values));
  ASSERT_EQ(back.size(), values.size());
  for (std::size_t i = 0; i < values.size(); ++i) {
    if (std::isnan(values[i])) {
      EXPECT_TRUE(std::isnan(back[i])) << i;
    } else {
      EXPECT_NEAR(back[i], values[i], tolerance) << i;
    }
  }
}

TEST(PackedColumns, KeepIntegersExact) {
  expect_equal({0, 1, kMissing, 254, 7}, 0);
  expect_equal({-30000, 30000, kMissing, 0}, 0);
  expect_equal({-2e9, 2e9, 5}, 0);
}

TEST(PackedColumns, KeepTheLargestAndSmallestIntegerApartFromMissing) {
  expect_equal({0, 254, 255}, 0);
  expect_equal({0, 65534, 65535}, 0);
}

TEST(PackedColumns, ResolveAThousandthOfAnEncoderCountOverTheWholeTank) {
  std::vector<double> values;
  for (int i = 0; i < 5000; ++i) {
    values.push_back(4.0 * std::sin(0.01 * i));
  }
  expect_equal(values, 1e-9);
}

TEST(PackedColumns, KeepAConstantAndAnEmptyColumn) {
  expect_equal({0.1, 0.1, kMissing}, 0);
  expect_equal({kMissing, kMissing}, 0);
  expect_equal({}, 0);
}

PlotTable long_table(std::size_t rows, std::size_t peak_row) {
  PlotTable table;
  table.rows = rows;
  table.source_rows = rows;
  PlotColumn time{"time_s", {}};
  PlotColumn error{"y_error_m", {}};
  for (std::size_t row = 0; row < rows; ++row) {
    time.values.push_back(static_cast<double>(row) * 1e-3);
    error.values.push_back(row == peak_row ? -1.0
                                           : 1e-3 * std::sin(0.1 * static_cast<double>(row)));
  }
  table.columns = {time, error};
  return table;
}

TEST(Thinned, LosesNoPeakWhereverItStands) {
  for (const std::size_t peak : {0UL, 1UL, 4999UL, 77777UL, 99998UL}) {
    const PlotTable thin = thinned(long_table(100'000, peak), 1000);
    EXPECT_LE(thin.rows, 1000U);
    const auto& error = thin.columns[1].values;
    const auto at = std::min_element(error.begin(), error.end());
    EXPECT_EQ(*at, -1.0);
    const auto row = static_cast<std::size_t>(at - error.begin());
    EXPECT_NEAR(thin.columns[0].values[row], static_cast<double>(peak) * 1e-3,
                static_cast<double>(thin.rows_per_bucket) * 1e-3);
  }
}

TEST(Thinned, KeepsTimeStrictlyIncreasing) {
  for (const std::size_t rows : {1001UL, 1002UL, 1003UL, 1004UL, 99'999UL}) {
    const PlotTable thin = thinned(long_table(rows, 5), 1000);
    for (std::size_t row = 1; row < thin.rows; ++row) {
      ASSERT_LT(thin.columns[0].values[row - 1], thin.columns[0].values[row]) << rows;
    }
  }
}

TEST(Thinned, LeavesAShortTableAsItIs) {
  const PlotTable table = long_table(1000, 5);
  EXPECT_EQ(thinned(table, 1000).columns[1].values, table.columns[1].values);
}

}  // namespace
}  // namespace towbench::harness::report
