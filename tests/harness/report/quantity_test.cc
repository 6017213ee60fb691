#include "harness/report/quantity.h"

#include <cmath>

#include <gtest/gtest.h>

#include "harness/report/histogram.h"
#include "harness/report/limit_bar.h"

namespace towbench::harness::report {
namespace {

TEST(Quantity, IsShownInTheUnitThatReadsBest) {
  EXPECT_EQ(readable_quantity(3.1e-4, "m"), "310\u00a0µm");
  EXPECT_EQ(readable_quantity(-0.0025, "m"), "−2.5\u00a0mm");
  EXPECT_EQ(readable_quantity(0.4, "m/s"), "400\u00a0mm/s");
  EXPECT_EQ(readable_quantity(0.0016, "s"), "1.6\u00a0ms");
  EXPECT_EQ(readable_quantity(12.5, "%"), "12.5\u00a0%");
  EXPECT_EQ(readable_quantity(12300, ""), "12300");
  EXPECT_EQ(readable_quantity(2.5, "N m"), "2.5\u00a0N m");
}

TEST(Quantity, HasFourSignificantDigits) {
  EXPECT_EQ(readable_number(0.123456), "0.1235");
  EXPECT_EQ(readable_number(999.96), "1000");
  EXPECT_EQ(readable_number(-1234.5678), "−1235");
  EXPECT_EQ(readable_number(0), "0");
  EXPECT_EQ(readable_number(1.5e-7), "1.500e-07");
}

TEST(Quantity, NamesWhatIsNoNumber) {
  EXPECT_EQ(readable_number(std::nan("")), "not a number");
  EXPECT_EQ(readable_number(HUGE_VAL), "∞");
}

TEST(LimitBar, PutsTheMarkInsideTheBandExactlyWhenTheValueIsAllowed) {
  const auto percent_after = [](const std::string& html, const char* what) {
    const std::size_t at = html.find("left:", html.find(what));
    return std::stod(html.substr(at + 5));
  };
  for (const double value : {-3.0, -1.0, -0.5, 0.0, 0.5, 0.99, 1.01, 5.0}) {
    const std::string bar = limit_bar({value, -1.0, 1.0});
    const double mark = percent_after(bar, "mark");
    const double from = percent_after(bar, "band");
    const double to = 100 - from;
    EXPECT_EQ(mark >= from && mark <= to, value >= -1.0 && value <= 1.0) << value;
  }
}

TEST(LimitBar, StaysInsideItsBoxWhateverTheValue) {
  for (const double value : {-1e9, -1.0, 0.0, 1.0, 1e9}) {
    for (const auto& bar :
         {LimitBar{value, -2.0, {}}, LimitBar{value, {}, -2.0}, LimitBar{value, 2.0, {}},
          LimitBar{value, {}, 2.0}, LimitBar{value, 0.0, 0.0}, LimitBar{value, {}, 0.0}}) {
      const std::string html = limit_bar(bar);
      EXPECT_EQ(html.find("nan"), std::string::npos);
      EXPECT_EQ(html.find("inf"), std::string::npos);
      EXPECT_EQ(html.find("width:-"), std::string::npos) << html;
    }
  }
}

TEST(LimitBar, IsEmptyWithoutALimitOrAValue) {
  EXPECT_EQ(limit_bar({1.0, {}, {}}), "");
  EXPECT_EQ(limit_bar({std::nan(""), 0.0, 1.0}), "");
}

TEST(Distribution, TakesPercentilesByNearestRank) {
  std::vector<double> values;
  for (int i = 1000; i >= 1; --i) {
    values.push_back(i);
  }
  values.push_back(std::nan(""));
  const Distribution d = distribution_of(values);
  EXPECT_EQ(d.samples, 1000U);
  EXPECT_EQ(d.min, 1);
  EXPECT_EQ(d.max, 1000);
  EXPECT_EQ(d.p50, 500);
  EXPECT_EQ(d.p99, 990);
  EXPECT_EQ(d.p99_9, 999);
  EXPECT_DOUBLE_EQ(d.mean, 500.5);
}

TEST(Distribution, DrawsEverySampleOnce) {
  const std::string svg = histogram_svg({1.0, 1.05, 50.0, 1000.0}, "µs");
  std::size_t drawn = 0;
  for (std::size_t at = svg.find("<title>"); at != std::string::npos;
       at = svg.find("<title>", at + 1)) {
    drawn += std::stoul(svg.substr(at + 7));
  }
  EXPECT_EQ(drawn, 4U);
  EXPECT_EQ(histogram_svg({}, "µs"), "");
}

}  // namespace
}  // namespace towbench::harness::report
