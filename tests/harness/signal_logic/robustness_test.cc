// The margin of a formula: by its definition on random traces, and where it is known.
#include "harness/signal_logic/robustness.h"

#include <cmath>

#include <gtest/gtest.h>

#include "harness/signal_logic/formula_text.h"
#include "tests/harness/signal_logic/brute_force.h"

namespace towbench::harness {
namespace {

const Vocabulary kWords{.signals = {{"a", "1"}, {"b", "1"}, {"c", "1"}},
                        .events = {"knock", "rest"},
                        .windows = {"middle"}};

Trace trace_of(const tests::PlainTrace& plain) {
  return {.time_s = plain.time_s,
          .signals = plain.signals,
          .events = {{"knock", plain.event_s}, {"rest", plain.end_s}},
          .windows = {{"middle", {plain.window_from_s, plain.window_to_s}}}};
}

bool same(double a, double b) {
  return a == b || (std::isnan(a) && std::isnan(b));
}

TEST(Robustness, IsWhatItsDefinitionSaysOnRandomTracesAndFormulas) {
  std::mt19937 random(7);  // NOLINT(cert-msc51-cpp): the same formulas every time
  std::size_t finite = 0;
  std::size_t broken = 0;
  for (int i = 0; i < 1200; ++i) {
    const auto plain = tests::drawn_trace(random);
    const auto formula = tests::drawn_formula(random, 1 + i % 3);
    const auto parsed = parse_formula(formula->text(), kWords);
    ASSERT_TRUE(parsed) << formula->text() << ": " << parsed.error().given << " at "
                        << parsed.error().column << "; " << parsed.error().allowed;
    const auto trace = trace_of(plain);
    const auto margin = evaluate(parsed->formula, trace, Reading::kMargin);
    const auto truth = evaluate(parsed->formula, trace, Reading::kTruth);
    ASSERT_EQ(margin.size(), plain.time_s.size());
    // Comparisons of margins with different numbers count in units of those numbers.
    for (std::size_t s = 0; s < margin.size(); ++s) {
      ASSERT_TRUE(same(margin[s], formula->at(plain, s, false)))
          << formula->text() << " at " << s << ": " << margin[s] << ", not "
          << formula->at(plain, s, false);
      const double holds = formula->at(plain, s, true);
      ASSERT_TRUE(same(truth[s] > 0   ? 1
                       : truth[s] < 0 ? -1
                                      : truth[s],
                       holds > 0   ? 1
                       : holds < 0 ? -1
                                   : holds))
          << formula->text() << " at " << s;
      ASSERT_FALSE(margin[s] > 0 && truth[s] < 0) << formula->text();
      ASSERT_FALSE(margin[s] < 0 && truth[s] > 0) << formula->text();
      finite += std::isfinite(margin[s]) ? 1U : 0U;
      broken += truth[s] < 0 ? 1U : 0U;
    }
  }
  // Neither mostly empty nor all alike.
  EXPECT_GT(finite, 5000U);
  EXPECT_GT(broken, 2000U);
}

// Were a window walked for every sample this would be 10^10 steps.
TEST(Robustness, OfALongRecordIsReadInOnePass) {
  constexpr std::size_t kSamples = 200'000;
  Trace trace;
  std::vector<double> wave;
  for (std::size_t i = 0; i < kSamples; ++i) {
    trace.time_s.push_back(static_cast<double>(i) * 1e-3);
    wave.push_back(std::sin(static_cast<double>(i) * 1e-4));
  }
  trace.signals = {wave, wave, wave};
  const auto parsed = parse_formula(
      "always: (eventually within 63 s: a > 0.999) and (a < 2 until within 63 s b > 0.999)",
      kWords);
  ASSERT_TRUE(parsed);
  const auto found = robustness_of(parsed->formula, trace);
  // Its crest comes back every 62.8 s, but not behind the last one.
  ASSERT_TRUE(found.margin);
  EXPECT_FALSE(found.holds);
  EXPECT_NEAR(*found.margin, wave.back() - 0.999, 1e-12);
}

Robustness of(const char* text, std::vector<double> values, std::vector<double> knocks = {},
              std::vector<double> rests = {}) {
  Trace trace;
  for (std::size_t i = 0; i < values.size(); ++i) {
    trace.time_s.push_back(static_cast<double>(i) * 1e-3);
  }
  trace.signals = {std::move(values), {}, {}};
  trace.events = {{"knock", std::move(knocks)}, {"rest", std::move(rests)}};
  const auto parsed = parse_formula(text, kWords);
  EXPECT_TRUE(parsed) << text;
  return robustness_of(parsed->formula, trace);
}

TEST(Robustness, IsTheDistanceToTheLimitAtTheWorstMoment) {
  const auto found = of("always: |a| < 3", {0, 1, -2.5, 2});
  EXPECT_EQ(found.margin, 0.5);
  EXPECT_EQ(found.worst_s, 2e-3);
  EXPECT_TRUE(found.holds);
}

TEST(Robustness, OfAStrictLimitThatIsMetExactlyIsZeroAndBroken) {
  EXPECT_FALSE(of("always: a < 3", {3}).holds);
  EXPECT_TRUE(of("always: a <= 3", {3}).holds);
  EXPECT_EQ(of("always: a < 3", {3}).margin, 0.0);
}

// A sample lasts until the next one: what is driven at 2 ms is still driven at the deadline of
// 2.3 ms.
TEST(Robustness, AfterAnEventBeginsWithTheSampleThatHoldsAtTheDeadline) {
  EXPECT_FALSE(of("after knock within 2 ms: a = 0", {0, 5, 5, 0, 0}, {0.3e-3}).holds);
  EXPECT_TRUE(of("after knock within 2 ms: a = 0", {5, 5, 0, 0, 0}, {0.3e-3}).holds);
  EXPECT_TRUE(of("after knock within 2 ms: a = 0", {5, 5, 0, 0, 0}, {0}).holds);
  EXPECT_FALSE(of("after knock within 2 ms: a = 0", {5, 5, 5, 0, 0}, {0}).holds);
  EXPECT_FALSE(of("after knock: a = 0 until rest", {0, 0, 0, 7}, {0}).holds);
  EXPECT_TRUE(of("after knock: a = 0 until rest", {0, 0, 0, 7}, {0}, {3e-3}).holds);
}

TEST(Robustness, ThatNothingGaveOccasionForIsNone) {
  EXPECT_FALSE(of("after knock within 2 ms: a = 0", {0, 0, 0}).margin);
  EXPECT_FALSE(of("always: b < 3", {0, 0, 0}).margin);
  EXPECT_FALSE(of("always: a < 3", {}).margin);
  EXPECT_FALSE(of("always in middle: a < 3", {1, 2}).margin);
}

}  // namespace
}  // namespace towbench::harness
