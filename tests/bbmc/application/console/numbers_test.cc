#include <array>
#include <charconv>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <limits>
#include <string>

#include <gtest/gtest.h>

#include "bbmc/application/console/decimal.h"
#include "bbmc/application/console/quantity.h"
#include "bbmc/application/console/text_writer.h"
#include "core/random.h"

namespace towbench::bbmc {
namespace {

std::string fixed(double value, int decimals) {
  std::array<char, 64> storage{};
  TextWriter writer(storage);
  writer.fixed(value, decimals);
  EXPECT_FALSE(writer.truncated());
  return std::string(writer.view());
}

std::string compact(double value, int decimals) {
  std::array<char, 64> storage{};
  TextWriter writer(storage);
  return std::string(writer.compact(value, decimals).view());
}

// Truth: the C library's own conversion.
TEST(Decimal, IsCorrectToTheLastBitForFifteenDigits) {
  core::Random random(1);
  for (int i = 0; i < 100'000; ++i) {
    const int digits = 1 + static_cast<int>(random.bits() % 15);
    std::string text = (random.bits() & 1U) != 0 ? "-" : "";
    const auto point = static_cast<int>(random.bits() % 16);
    for (int k = 0; k < digits; ++k) {
      text += k == point ? "." : "";
      text += static_cast<char>('0' + random.bits() % 10);
    }
    if ((random.bits() & 3U) == 0) {
      text += "e" + std::to_string(static_cast<int>(random.bits() % 15) - 7);
    }
    const auto number = parse_decimal(text);
    ASSERT_TRUE(number) << text;
    ASSERT_EQ(number->value, std::strtod(text.c_str(), nullptr)) << text;
    ASSERT_EQ(number->rest, "") << text;
  }
}

TEST(Decimal, StaysWithinTwoUnitsInTheLastPlaceForWhateverElse) {
  core::Random random(2);
  for (int i = 0; i < 100'000; ++i) {
    std::string text;
    const int digits = 1 + static_cast<int>(random.bits() % 40);
    for (int k = 0; k < digits; ++k) {
      text += static_cast<char>('0' + random.bits() % 10);
    }
    text.insert(random.bits() % text.size(), ".");
    text += "e" + std::to_string(static_cast<int>(random.bits() % 400) - 200);
    const auto number = parse_decimal(text);
    ASSERT_TRUE(number) << text;
    const double truth = std::strtod(text.c_str(), nullptr);
    ASSERT_NEAR(number->value, truth, 40 * std::numeric_limits<double>::epsilon() * truth) << text;
  }
}

TEST(Decimal, TakesANumberAndLeavesItsUnit) {
  const auto rest = [](std::string_view text) { return parse_decimal(text)->rest; };
  EXPECT_EQ(rest("0.4m/s"), "m/s");
  EXPECT_EQ(rest("15%"), "%");
  EXPECT_EQ(rest("3e"), "e");
  EXPECT_EQ(rest("3e+"), "e+");
  EXPECT_EQ(rest("3e2s"), "s");
  EXPECT_EQ(rest("1.2.3"), ".3");
  EXPECT_EQ(parse_decimal(".5")->value, 0.5);
  EXPECT_EQ(parse_decimal("5.")->value, 5);
  EXPECT_EQ(parse_decimal("+7")->value, 7);
  EXPECT_TRUE(std::signbit(parse_decimal("-0")->value));
}

TEST(Decimal, RefusesWhatIsNoNumber) {
  for (const std::string_view text : {"", "-", "+", ".", "-.", "e5", "nan", "inf", "m", "--1",
                                      "+-1", "1e301", "1e999999999999"}) {
    EXPECT_FALSE(parse_decimal(text)) << text;
  }
  EXPECT_FALSE(parse_decimal(std::string(400, '9')));
  EXPECT_EQ(parse_decimal("1e-999999999999")->value, 0);
}

TEST(Integer, TakesAllOfTheTextOrNothing) {
  EXPECT_EQ(parse_integer("1650000"), 1'650'000);
  EXPECT_EQ(parse_integer("-9223372036854775808"), std::numeric_limits<std::int64_t>::min());
  EXPECT_EQ(parse_integer("+3"), 3);
  for (const std::string_view text :
       {"", "+", "-", "+-3", "3.0", "3 ", "0x3", "9223372036854775808"}) {
    EXPECT_FALSE(parse_integer(text)) << text;
  }
}

TEST(TextWriter, FixedIsTheNearestDecimalNumber) {
  core::Random random(3);
  for (int i = 0; i < 100'000; ++i) {
    const int decimals = static_cast<int>(random.bits() % 10);
    const double value = (random.uniform() - 0.5) * std::pow(10.0, random.uniform() * 12 - 6);
    const std::string text = fixed(value, decimals);
    // Half a step, and what subtracting two doubles costs.
    const double half_step = 0.5 * std::pow(10.0, -decimals);
    ASSERT_NEAR(std::strtod(text.c_str(), nullptr), value,
                half_step + 1e-15 * std::fabs(value) + 1e-18)
        << text;
    std::array<char, 64> truth{};
    std::snprintf(truth.data(), truth.size(), "%.*f", decimals, value);
    ASSERT_EQ(text.size() - (text[0] == '-' ? 1 : 0),
              std::string_view(truth.data()).size() - (truth[0] == '-' ? 1 : 0))
        << text << " against " << truth.data();
  }
}

TEST(TextWriter, WritesTheHardCases) {
  EXPECT_EQ(fixed(0, 3), "0.000");
  EXPECT_EQ(fixed(-0.0, 3), "0.000");
  EXPECT_EQ(fixed(-0.0001, 3), "0.000");
  EXPECT_EQ(fixed(0.9999, 3), "1.000");
  EXPECT_EQ(fixed(-9.9996, 3), "-10.000");
  EXPECT_EQ(fixed(0.05, 3), "0.050");
  EXPECT_EQ(fixed(12, 0), "12");
  EXPECT_EQ(fixed(std::nan(""), 3), "nan");
  EXPECT_EQ(fixed(-std::numeric_limits<double>::infinity(), 3), "-inf");
  EXPECT_NE(fixed(1e300, 3).find('e'), std::string::npos);
  EXPECT_EQ(compact(0.400, 6), "0.4");
  EXPECT_EQ(compact(20, 6), "20");
  EXPECT_EQ(compact(100, 0), "100");
  EXPECT_EQ(compact(0, 6), "0");
}

TEST(TextWriter, IntegersOfEverySize) {
  std::array<char, 64> storage{};
  TextWriter writer(storage);
  writer.integer(std::numeric_limits<std::int64_t>::min()).text(" ").integer(0);
  EXPECT_EQ(writer.view(), "-9223372036854775808 0");
}

TEST(TextWriter, NeverWritesBeyondItsStorageAndSaysSo) {
  std::array<char, 8> storage{};
  storage.back() = '#';
  TextWriter writer(std::span<char>(storage).first(7));
  writer.text("12345").fixed(3.25, 2);
  EXPECT_EQ(writer.view(), "123453.");
  EXPECT_TRUE(writer.truncated());
  EXPECT_EQ(storage.back(), '#');
  writer.clear();
  EXPECT_FALSE(writer.truncated());
  writer.column(100);
  EXPECT_TRUE(writer.truncated());
}

struct UnitCase {
  std::string_view text;
  Dimension dimension;
  std::string_view bare;
  double value_si;
};

TEST(Quantity, EveryUnitMeansWhatItSays) {
  constexpr double kCountsPerM = 445'345;
  for (const UnitCase& unit : std::initializer_list<UnitCase>{
           {"2m", Dimension::kLength, "counts", 2},
           {"20cm", Dimension::kLength, "m", 0.2},
           {"400mm", Dimension::kLength, "m", 0.4},
           {"5um", Dimension::kLength, "m", 5e-6},
           {"2", Dimension::kLength, "m", 2},
           {"445345counts", Dimension::kLength, "m", 1},
           {"445345", Dimension::kLength, "counts", 1},
           {"0.4m/s", Dimension::kSpeed, "m/s", 0.4},
           {"40cm/s", Dimension::kSpeed, "m/s", 0.4},
           {"400mm/s", Dimension::kSpeed, "m/s", 0.4},
           {"44534.5counts/s", Dimension::kSpeed, "m/s", 0.1},
           {"300ms", Dimension::kTime, "s", 0.3},
           {"300", Dimension::kTime, "ms", 0.3},
           {"0.3s", Dimension::kTime, "ms", 0.3},
           {"15%", Dimension::kDuty, "%", 15},
           {"15", Dimension::kDuty, "%", 15},
           {"150mHz", Dimension::kFrequency, "Hz", 0.15},
           {"1kHz", Dimension::kFrequency, "Hz", 1000},
           {"0.12Nm/rad", Dimension::kProportionalGain, kBbmcGainUnit, 0.12},
           {"0.008", Dimension::kProportionalGain, kBbmcGainUnit, 0.008},
       }) {
    const auto value = parse_quantity(unit.text, unit.dimension, unit.bare, kCountsPerM);
    ASSERT_TRUE(value) << unit.text;
    // To the last bit: 400mm is 0.4 m, not 0.4000000000000001 m.
    EXPECT_DOUBLE_EQ(*value, unit.value_si) << unit.text;
  }
}

TEST(Quantity, ACountAsAPositionIsTheMiddleOfTheCount) {
  EXPECT_DOUBLE_EQ(*parse_quantity("1000", Dimension::kPosition, "counts", 1e6), 1000.5e-6);
  EXPECT_DOUBLE_EQ(*parse_quantity("1000counts", Dimension::kLength, "m", 1e6), 1000e-6);
}

TEST(Quantity, RefusesWrongUnitsMissingNumbersAndCountsOfNoAxis) {
  for (const std::string_view text : {"", "m", "2s", "2%", "2 m", "2mm/s", "2M", "2mm2", "nanm",
                                      "infm", "0x10m", "1e400m", "2,5m"}) {
    EXPECT_FALSE(parse_quantity(text, Dimension::kLength, "m", 1e5)) << text;
  }
  EXPECT_FALSE(parse_quantity("10counts", Dimension::kLength, "m", 0));
  EXPECT_FALSE(parse_quantity("10", Dimension::kLength, "counts", 0));
  EXPECT_TRUE(parse_quantity("10mm", Dimension::kLength, "counts", 0));
}

}  // namespace
}  // namespace towbench::bbmc
