// What people hand to the program when something went wrong: one line that says where and what,
// exit code 2, and nothing written; or, when it is only spelt otherwise, the same answer.
#include <algorithm>
#include <chrono>
#include <cmath>
#include <csignal>
#include <functional>
#include <ostream>
#include <string>
#include <thread>
#include <vector>

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/wait.h>
#include <unistd.h>

#include "core/random.h"
#include "tests/study/diagnose/brought_case.h"

namespace towbench::tests {
namespace {

using ::testing::HasSubstr;
using ::testing::StartsWith;
using Spoil = std::function<void(HiddenLog&)>;

HiddenAxis short_axis() {
  HiddenAxis axis;
  axis.duration_s = 8;
  return axis;
}

const HiddenLog& good_log() {
  static const HiddenLog kLog = make_hidden_log(short_axis(), 1);
  return kLog;
}

std::string spoilt(const Spoil& spoil) {
  HiddenLog log = good_log();
  spoil(log);
  return csv_of(short_axis(), log);
}

std::string good_csv() {
  return csv_of(short_axis(), good_log());
}

std::string replaced(std::string text, const std::string& what, const std::string& by) {
  for (std::size_t at = 0; (at = text.find(what, at)) != std::string::npos; at += by.size()) {
    text.replace(at, what.size(), by);
  }
  return text;
}

void times(std::vector<double>& column, double factor, std::size_t from = 0) {
  for (std::size_t i = from; i < column.size(); ++i) {
    column[i] *= factor;
  }
}

struct BadLog {
  const char* name;
  const char* told;
  std::function<std::string()> text;
};
void PrintTo(const BadLog& bad, std::ostream* out) {
  *out << bad.name;
}

class BadLogs : public testing::TestWithParam<BadLog> {};

TEST_P(BadLogs, AreToldInOneLineAndLeaveNothing) {
  const BroughtCase brought(short_axis());
  brought.write("log.csv", GetParam().text());
  const auto output = brought.diagnose("--data log.csv");
  EXPECT_EQ(output.code, 2) << output.text;
  EXPECT_THAT(output.text, StartsWith("towbench: diagnose: "));
  EXPECT_THAT(output.text, HasSubstr(GetParam().told));
  EXPECT_EQ(std::count(output.text.begin(), output.text.end(), '\n'), 1) << output.text;
  EXPECT_FALSE(std::filesystem::exists(brought.out()));
}

const std::vector<BadLog>& bad_logs() {
  static const std::vector<BadLog> kAll{
      {"Empty", "file_unreadable: log.csv", [] { return std::string(); }},
      {"HeaderAlone", "no_rows: log.csv",
       [] { return rows_where(good_csv(), [](auto) { return false; }); }},
      {"WithoutHeader", "header_unusable: log.csv:1: numbers",
       [] { return good_csv().substr(good_csv().find('\n') + 1); }},
      {"Binary", "header_unusable: log.csv:1", [] { return std::string(200'000, '\0'); }},
      {"OneEndlessLine", "header_unusable: log.csv:1", [] { return std::string(200'000, 'x'); }},
      {"DecimalCommasBetweenCommas", "rows_unlike_header: log.csv:2: 7 cells",
       [] { return replaced(good_csv(), ".", ","); }},
      {"WithANameTwice", "column_twice: log.csv: the header names 'y_count' 2 times",
       [] { return replaced(good_csv(), "y_reference_m", "y_count"); }},
      {"WithoutItsInput", "columns_unusable: log.csv: no column 'y_force_N'",
       [] { return replaced(good_csv(), "y_duty_pct", "whatever"); }},
      {"OfWords", "not_a_number: log.csv:2: 'y_duty_pct'",
       [] { return spoilt([](auto& log) { times(log.duty_pct, NAN); }); }},
      {"Short", "too_short: log.csv: 200 usable samples",
       [] { return rows_where(good_csv(), [](auto row) { return row <= 200; }); }},
      {"WithADeadEncoder", "constant_position: log.csv: 'y_count'",
       [] { return spoilt([](auto& log) { times(log.position_m, 0); }); }},
      {"WithADeadInput", "constant_input: log.csv: 'y_duty_pct'",
       [] { return spoilt([](auto& log) { times(log.duty_pct, 0); }); }},
      {"OfTwoRunsInOneFile", "time_not_rising: log.csv:8002",
       [] { return good_csv() + good_csv().substr(good_csv().find('\n') + 1); }},
      {"InMilliseconds", "sampling_rate_off: log.csv",
       [] { return spoilt([](auto& log) { times(log.time_s, 1000); }); }},
      {"OfWhichTimeChangesItsUnit", "sampling_changes: log.csv",
       [] { return spoilt([](auto& log) { times(log.time_s, 20, 5000); }); }},
      {"OfWhichHalfIsMissing", "missing_samples: log.csv: 50 %",
       [] {
         core::Random random(1);
         return rows_where(good_csv(), [&](auto) { return random.uniform() > 0.5; });
       }},
      {"InMillimetres", "position_unit_off: log.csv",
       [] { return spoilt([](auto& log) { times(log.position_m, 1000); }); }},
      {"OfWhichThePositionChangesItsUnit", "position_unit_off: log.csv",
       [] { return spoilt([](auto& log) { times(log.position_m, 1000, 4000); }); }},
      {"InKilometres", "reference_unit_off: log.csv: the position goes 0 times as far",
       [] { return spoilt([](auto& log) { times(log.position_m, 1e-3); }); }},
      {"WithAThousandTimesTheInput", "input_unit_off: log.csv",
       [] { return spoilt([](auto& log) { times(log.duty_pct, 1000); }); }},
      {"WithAThousandthOfTheInput", "input_unit_off",
       [] { return spoilt([](auto& log) { times(log.duty_pct, 1e-3); }); }},
      {"WithARatioForAPercentage", "input_unit_off: the data ask for 0.01",
       [] { return spoilt([](auto& log) { times(log.duty_pct, 1e-2); }); }},
      {"WithTheCommandReversed", "command_sign_reversed",
       [] { return spoilt([](auto& log) { times(log.duty_pct, -1); }); }},
      {"WithThePositionReversed", "position_sign_reversed: log.csv",
       [] { return spoilt([](auto& log) { times(log.position_m, -1); }); }},
      {"OfWhichTheInputIsLate", "columns_shifted",
       [] {
         return spoilt([](auto& log) {
           log.duty_pct.insert(log.duty_pct.begin(), 80, log.duty_pct.front());
         });
       }},
      {"WithTheColumnsShiftedByOne", "towbench",
       [] {
         return replaced(good_csv(), "time_s,y_reference_m,y_count,y_duty_pct",
                         "y_reference_m,y_count,y_duty_pct,time_s");
       }},
      {"OfNoise", "model_explains_nothing",
       [] {
         return spoilt([](auto& log) {
           core::Random random(1);
           for (double& duty : log.duty_pct) duty = 40 * random.uniform() - 20;
         });
       }},
  };
  return kAll;
}

INSTANTIATE_TEST_SUITE_P(All, BadLogs, testing::ValuesIn(bad_logs()),
                         [](const auto& parameter) { return std::string(parameter.param.name); });

// A loop that hunts goes half of the time against what is asked: that reverses no sign.
TEST(AReferenceOfSomethingElse, IsToldAndLeftOut) {
  const BroughtCase brought(short_axis());
  brought.write("log.csv", spoilt([](auto& log) {
                  log.reference_m = make_hidden_log(short_axis(), 2).reference_m;
                }));
  const auto output = brought.diagnose("--data log.csv");
  EXPECT_EQ(output.code, 0) << output.text;
  EXPECT_THAT(output.text, HasSubstr("reference_not_followed: log.csv"));
}

class OtherwiseSpelt : public testing::TestWithParam<BadLog> {};

TEST_P(OtherwiseSpelt, AreReadAsMeant) {
  const BroughtCase brought(short_axis());
  brought.write("log.csv", good_csv());
  ASSERT_EQ(brought.diagnose("--data log.csv").code, 0);
  const auto plain = brought.answer();
  brought.write("log.csv", GetParam().text());
  const auto output = brought.diagnose("--data log.csv");
  ASSERT_EQ(output.code, 0) << output.text;
  EXPECT_THAT(output.text, HasSubstr(GetParam().told));
  auto answer = brought.answer();
  answer["findings"] = plain.at("findings");
  EXPECT_EQ(answer, plain);
}

INSTANTIATE_TEST_SUITE_P(
    All, OtherwiseSpelt,
    testing::Values(
        BadLog{"WithCarriageReturns", "", [] { return replaced(good_csv(), "\n", "\r\n"); }},
        BadLog{"WithAByteOrderMark", "", [] { return "\xEF\xBB\xBF" + good_csv(); }},
        BadLog{"WithACommentAbove", "", [] { return "# a Tuesday\n" + good_csv(); }},
        BadLog{"PartedBySemicolons", "", [] { return replaced(good_csv(), ",", ";"); }},
        BadLog{"WithDecimalCommas", "",
               [] { return replaced(replaced(good_csv(), ",", ";"), ".", ","); }},
        BadLog{"PartedByTabs", "", [] { return replaced(good_csv(), ",", "\t"); }},
        BadLog{"WithACommaAtEachEnd", "", [] { return replaced(good_csv(), "\n", ",\n"); }},
        BadLog{"WithARowOfUnits", "not_a_number",
               [] { return good_csv().insert(good_csv().find('\n') + 1, "s,m,1,%\n"); }}),
    [](const auto& parameter) { return std::string(parameter.param.name); });

TEST(AbsurdValue, IsLeftOutAndTold) {
  const BroughtCase brought(short_axis());
  brought.write("log.csv", spoilt([](auto& log) { log.duty_pct[4000] = 1e300; }));
  const auto output = brought.diagnose("--data log.csv");
  EXPECT_EQ(output.code, 0) << output.text;
  EXPECT_THAT(output.text, HasSubstr("absurd_values: log.csv:4002: 'y_duty_pct' is 1e+300"));
  EXPECT_EQ(names_in(brought.answer()), "");
}

TEST(StoppedDiagnosis, EndsWithThreeAndLeavesNothing) {
  HiddenAxis axis = short_axis();
  axis.duration_s = 120;
  const BroughtCase brought(axis);
  brought.write("log.csv", csv_of(axis, make_hidden_log(axis, 1)));
  for (const int signal : {SIGINT, SIGTERM}) {
    const pid_t child = fork();
    if (child == 0) {
      const std::string command = brought.command("--data log.csv --quiet 2>/dev/null");
      execl("/bin/sh", "sh", "-c", command.c_str(), nullptr);
      _exit(127);
    }
    std::this_thread::sleep_for(std::chrono::milliseconds(700));  // of several seconds
    kill(child, signal);
    int status = 0;
    waitpid(child, &status, 0);
    EXPECT_TRUE(WIFEXITED(status));
    EXPECT_EQ(WEXITSTATUS(status), 3);
    EXPECT_FALSE(std::filesystem::exists(brought.out()));
  }
}

}  // namespace
}  // namespace towbench::tests
