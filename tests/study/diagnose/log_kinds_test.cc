// Logs as different benches write them, through the program itself: an effect that the log could
// show is named from each and nothing else is; what a log cannot show is said.
#include <algorithm>
#include <fstream>
#include <iterator>
#include <ostream>
#include <string>

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "core/random.h"
#include "tests/study/diagnose/brought_case.h"

namespace towbench::tests {
namespace {

using ::testing::HasSubstr;

struct LogKind {
  const char* name;
  double counts_per_rev = 4000;
  double rate_Hz = 1000;
  double duty_step_pct = 0.1;
  bool open_loop = false;
  double duration_s = 20;
};
void PrintTo(const LogKind& kind, std::ostream* out) {
  *out << kind.name;
}

HiddenAxis axis_of(const LogKind& kind) {
  HiddenAxis axis;
  axis.counts_per_m = kind.counts_per_rev * axis.motor_turns_per_m;
  axis.period_s = 1 / kind.rate_Hz;
  axis.duty_step_pct = kind.duty_step_pct;
  axis.open_loop = kind.open_loop;
  axis.duration_s = kind.duration_s;
  return axis;
}

class LogKinds : public testing::TestWithParam<LogKind> {};

TEST_P(LogKinds, AnEffectIsNamedAloneFromTheLog) {
  HiddenAxis axis = axis_of(GetParam());
  axis.effect = "viscous_asymmetry";
  const BroughtCase brought(axis);
  brought.write("log.csv", csv_of(axis, make_hidden_log(axis, 1)));
  const auto output = brought.diagnose("--data log.csv");
  EXPECT_EQ(output.code, 0) << output.text;
  EXPECT_EQ(names_in(brought.answer()), axis.effect) << output.text;
}

TEST_P(LogKinds, NothingIsNamedWhereNothingIsHidden) {
  const HiddenAxis axis = axis_of(GetParam());
  const BroughtCase brought(axis);
  brought.write("log.csv", csv_of(axis, make_hidden_log(axis, 2)));
  const auto output = brought.diagnose("--data log.csv");
  EXPECT_EQ(output.code, 0) << output.text;
  EXPECT_EQ(names_in(brought.answer()), "") << output.text;
  std::ifstream report(brought.out() / "report.html");
  const std::string page(std::istreambuf_iterator<char>(report), {});
  EXPECT_THAT(page, HasSubstr("Nothing was found that could be.")) << "a gain of nothing";
}

INSTANTIATE_TEST_SUITE_P(Of, LogKinds,
                         testing::Values(LogKind{"100_counts_a_turn", 100},
                                         LogKind{"500_counts_a_turn", 500},
                                         LogKind{"10000_counts_a_turn", 10000},
                                         LogKind{"200_Hz", 4000, 200}, LogKind{"500_Hz", 4000, 500},
                                         LogKind{"10_kHz", 4000, 1e4, 0.1},
                                         LogKind{"a_duty_of_10_bits", 4000, 1000, 200.0 / 1023},
                                         LogKind{"open_loop", 4000, 1000, 0.1, true}),
                         [](const auto& parameter) { return std::string(parameter.param.name); });

// All that is coarse at once: the effect is missed there, but nothing else is named for it.
TEST(CoarseLog, OfTheSlowestAndCoarsestMisnamesNothing) {
  const LogKind coarse{"coarse", 100, 200, 200.0 / 1023, false, 60};
  HiddenAxis axis = axis_of(coarse);
  for (const char* effect : {"", "viscous_asymmetry"}) {
    axis.effect = effect;
    const BroughtCase brought(axis);
    brought.write("log.csv", csv_of(axis, make_hidden_log(axis, 1)));
    const auto output = brought.diagnose("--data log.csv");
    ASSERT_EQ(output.code, 0) << output.text;
    EXPECT_THAT(names_in(brought.answer()), ::testing::AnyOf("", axis.effect)) << output.text;
  }
}

// What a log is that a person has had trouble with, told by the effect in it.
class TroubledLog : public testing::Test {
 protected:
  TroubledLog() {
    axis_.effect = "viscous_asymmetry";
    axis_.duration_s = 20;
    axis_.machine = 1;
    csv_ = csv_of(axis_, make_hidden_log(axis_, 1));
  }
  void expect_named_alone(const std::string& arguments) {
    const auto output = brought_.diagnose(arguments);
    ASSERT_EQ(output.code, 0) << output.text;
    told_ = output.text;
    EXPECT_EQ(names_in(brought_.answer()), axis_.effect) << output.text;
  }

  HiddenAxis axis_;
  BroughtCase brought_;
  std::string csv_;
  std::string told_;
};

TEST_F(TroubledLog, OfWhichATenthOfTheSamplesIsMissingIsDiagnosed) {
  core::Random random(1);
  brought_.write("log.csv", rows_where(csv_, [&](std::size_t) { return random.uniform() > 0.1; }));
  expect_named_alone("--data log.csv");
  EXPECT_THAT(told_, HasSubstr("missing_samples"));
}

TEST_F(TroubledLog, WithASecondLostInTheMiddleIsDiagnosed) {
  brought_.write("log.csv",
                 rows_where(csv_, [&](std::size_t row) { return row < 9000 || row > 10000; }));
  expect_named_alone("--data log.csv");
  EXPECT_THAT(told_, HasSubstr("missing_samples"));
}

TEST_F(TroubledLog, WhoseTimeStampsJitterIsDiagnosed) {
  HiddenLog log = make_hidden_log(axis_, 1);
  core::Random random(1);
  for (double& t : log.time_s) {
    t += 0.2e-3 * (random.uniform() - 0.5);
  }
  brought_.write("log.csv", csv_of(axis_, log));
  expect_named_alone("--data log.csv");
  EXPECT_THAT(told_, HasSubstr("jittered_time"));
}

TEST_F(TroubledLog, InSeveralRunsIsDiagnosedAndJudgedOnTheLast) {
  axis_.duration_s = 40;  // a quarter of the last calibrates
  brought_.write("a.csv", csv_of(axis_, make_hidden_log(axis_, 1)));
  brought_.write("b.csv", csv_of(axis_, make_hidden_log(axis_, 3)));
  brought_.write("c.csv", csv_of(axis_, make_hidden_log(axis_, 2)));
  expect_named_alone("--data a.csv --data b.csv --holdout c.csv");
  EXPECT_FALSE(brought_.answer().at("heldout").at("same_session").get<bool>());
}

// The current that was measured in place of the duty that was commanded, under foreign names.
TEST_F(TroubledLog, WithAChannelOfCurrentIsDiagnosedByAMap) {
  constexpr double kA_per_pct = 0.037;
  HiddenLog log = make_hidden_log(axis_, 1);
  std::string text = "t_ms;Weg_mm;Strom_A\n";
  for (std::size_t k = 0; k < log.time_s.size(); ++k) {
    text += fmt::format("{:.1f};{:.5f};{:.6f}\n", 1e3 * log.time_s[k], 1e3 * log.position_m[k],
                        kA_per_pct * log.duty_pct[k]);
  }
  std::replace(text.begin(), text.end(), '.', ',');
  brought_.write("log.csv", text);
  brought_.write("map.toml",
                 fmt::format("time = \"t_ms\"\ntime_scale_s = 0.001\nposition = \"Weg_mm\"\n"
                             "position_scale_m = 0.001\ninput = \"Strom_A\"\ninput_scale_N = {}\n",
                             axis_.newton_per_duty_pct / kA_per_pct));
  expect_named_alone("--data log.csv --columns map.toml");
}

TEST_F(TroubledLog, ThatIsTooLittleSaysWhatItWouldTake) {
  brought_.write("log.csv", rows_where(csv_, [](std::size_t row) { return row < 800; }));
  const auto output = brought_.diagnose("--data log.csv");
  EXPECT_EQ(output.code, 2);
  EXPECT_THAT(output.text, HasSubstr("too_little_motion"));
  EXPECT_THAT(output.text, HasSubstr("log longer, or give another run"));
}

}  // namespace
}  // namespace towbench::tests
