#include "core/error.h"

#include <fstream>
#include <map>
#include <regex>
#include <set>
#include <string>

#include <gtest/gtest.h>

#include "core/result.h"

namespace towbench::core {
namespace {

// The list as the header has it, so that a new error cannot be forgotten here.
std::multimap<int, std::string> listed_errors() {
  std::multimap<int, std::string> errors;
  std::ifstream header("core/error.h");
  const std::regex line(R"(^\s+(k\w+) = (\d+),)");
  std::smatch match;
  for (std::string text; std::getline(header, text);) {
    if (std::regex_search(text, match, line)) {
      errors.emplace(std::stoi(match[2]), match[1]);
    }
  }
  return errors;
}

TEST(Error, EveryNumberIsUsedOnceAndDescribedInItsOwnWords) {
  const auto errors = listed_errors();
  ASSERT_GT(errors.size(), 60U);
  std::set<std::string_view> phrases;
  for (const auto& [number, name] : errors) {
    const auto code = static_cast<ErrorCode>(number);
    EXPECT_EQ(errors.count(number), 1U) << number << " is used twice";
    EXPECT_TRUE(is_known(code)) << name << " has no description";
    EXPECT_FALSE(describe(code).empty()) << name;
    EXPECT_TRUE(phrases.insert(describe(code)).second)
        << name << " has the words of another: " << describe(code);
    EXPECT_EQ(number_of(code), number);
  }
}

TEST(Error, ANumberThatStandsForNothingIsNotKnown) {
  const auto errors = listed_errors();
  for (int number = 0; number <= 0xffff; ++number) {
    ASSERT_EQ(is_known(static_cast<ErrorCode>(number)), errors.contains(number)) << number;
  }
}

TEST(Result, CarriesAValueOrANumberedError) {
  const Result<int> value = 3;
  const Result<int> error = failure(ErrorCode::kDeviceBusy);
  EXPECT_TRUE(value.has_value());
  EXPECT_EQ(*value, 3);
  EXPECT_FALSE(error.has_value());
  EXPECT_EQ(error.error(), ErrorCode::kDeviceBusy);
  const Status fine;
  EXPECT_TRUE(fine.has_value());
}

}  // namespace
}  // namespace towbench::core
