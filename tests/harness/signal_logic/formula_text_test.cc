// Formulas as people write them, and what is refused in one line.
#include "harness/signal_logic/formula_text.h"

#include <random>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "harness/requirements/run_signals.h"

namespace towbench::harness {
namespace {

using ::testing::HasSubstr;

const Vocabulary kRun = run_vocabulary({"whole", "steady"});

std::string refused(const std::string& text) {
  const auto parsed = parse_formula(text, kRun);
  return parsed ? "accepted"
                : std::to_string(parsed.error().column) + ": " + parsed.error().given + "; " +
                      parsed.error().allowed;
}

TEST(FormulaText, OfTheGuideIsUnderstood) {
  for (const char* text :
       {"always in steady: |y_error| < 1 mm",
        "after kill_edge within 2 ms: |y_duty| = 0 until reset",
        "after kill_edge within 2 ms: |y_duty| = 0 and |x_duty| = 0 until reset",
        "always: y_speed > 0.3 m/s implies eventually within 1 s: |y_error| <= 20 um",
        "not eventually: hard_end_contact",
        "always: (y_state = 2 until within 3 s |y_error| < 1mm)",
        "always: 0.5 * y_reference - y_position <= -1 * x_position + 3 m"}) {
    EXPECT_EQ(refused(text), "accepted") << text;
  }
}

TEST(FormulaText, CountsInTheUnitThatItsComparisonsShare) {
  EXPECT_EQ(parse_formula("always: |y_error| < 1 mm", kRun)->unit, "m");
  EXPECT_EQ(parse_formula("always: |y_error| < 1 mm and y_speed < 1 m/s", kRun)->unit, "1");
  const auto mixed = parse_formula("always: |y_error| < 1 mm and y_speed < 2 m/s", kRun);
  EXPECT_EQ(mixed->formula.parts[0].parts[0].scale, 1e-3);
  EXPECT_EQ(mixed->formula.parts[0].parts[1].scale, 2.0);
}

TEST(FormulaText, SaysWhereAMistakeIsAndWhatIsAllowed) {
  EXPECT_THAT(refused("alway in steady: |y_error| < 1 mm"), HasSubstr("1: \"alway\"; a signal"));
  EXPECT_THAT(refused("always in stead: |y_error| < 1 mm"),
              HasSubstr("11: \"stead\"; the name of a window: whole steady"));
  EXPECT_THAT(refused("always: |y_eror| < 1 mm"), HasSubstr("10: \"y_eror\"; a signal: y_error"));
  EXPECT_THAT(refused("always: |y_error| < 1 s"),
              HasSubstr("21: a quantity in s; a quantity in m"));
  EXPECT_THAT(refused("always: |y_error| < 1"), HasSubstr("a quantity without a unit"));
  EXPECT_THAT(refused("always from 2 s to 1 s: fault = 0"), HasSubstr("an empty interval"));
  EXPECT_THAT(refused("after kill_edg: fault = 0"), HasSubstr("an event: kill_edge"));
  EXPECT_THAT(refused("fault = 0"), HasSubstr("a condition without a time"));
  EXPECT_THAT(refused("always: fault"), HasSubstr("\"the end\"; < <= > >= or ="));
  EXPECT_THAT(refused("always: fault = 0 fault"), HasSubstr("and, or, implies"));
  EXPECT_THAT(refused("always: fault = 1e999"), HasSubstr("a finite number"));
  EXPECT_THAT(refused("always; fault = 0"), HasSubstr("7: ;"));
  EXPECT_THAT(refused(""), HasSubstr("\"the end\""));
  EXPECT_THAT(refused(std::string(300, '(')), HasSubstr("at most 40"));
  EXPECT_THAT(refused("always: " + std::string(3000, '-')), HasSubstr("at most 2000"));
}

// As fuzzing does, from what is right: whatever comes out is a formula or one mistake in one line.
TEST(FormulaText, ThatIsDamagedIsRefusedInOneLine) {
  std::mt19937 random(3);  // NOLINT(cert-msc51-cpp): the same damage every time
  const std::string sound =
      "always: y_speed > 0.3 m/s implies eventually within 1 s: (|y_error| <= 20 um until "
      "fault = 0)";
  const std::string letters = "ay_ |<>=()+-*:.059ms/%\n";
  std::size_t refusals = 0;
  for (int i = 0; i < 20'000; ++i) {
    auto text = sound;
    for (std::size_t n = 1 + random() % 4; n-- > 0;) {
      const auto at = random() % text.size();
      const char letter = letters[random() % letters.size()];
      random() % 2 == 0 ? text.erase(at, 1 + random() % 5) : text.insert(at, 1, letter);
      text += text.empty() ? "a" : "";
    }
    const auto parsed = parse_formula(text, kRun);
    if (!parsed) {
      ++refusals;
      ASSERT_FALSE(parsed.error().allowed.empty()) << text;
      ASSERT_FALSE(parsed.error().given.empty()) << text;
      ASSERT_LE(parsed.error().column, text.size() + 1) << text;
      ASSERT_GE(parsed.error().column, 1U) << text;
    }
  }
  EXPECT_GT(refusals, 10'000U);
  EXPECT_LT(refusals, 20'000U);
}

}  // namespace
}  // namespace towbench::harness
