// The gain must be honest: a term that only memorises the data it was fitted on must show none.
#include "study/diagnose/heldout.h"

#include <gtest/gtest.h>

#include "core/random.h"
#include "study/diagnose/context.h"
#include "tests/study/diagnose/hidden_case.h"

namespace towbench::tests {
namespace {

using namespace harness::diagnose;

bool on_all_rows(Eigen::Index /*row*/, Eigen::Index /*rows*/) {
  return true;
}

// Forty lines of arbitrary frequency: fits noise, predicts nothing.
std::vector<Term> memorising_terms() {
  std::vector<Term> terms;
  for (int i = 0; i < 40; ++i) {
    terms.push_back({find_effect("periodic_force"), {0.35 + 0.95 * i}});
  }
  return terms;
}

struct Gains {
  Gain on_itself;
  Gain on_another;
};

Gains gains_of_memory() {
  HiddenAxis axis;
  axis.duration_s = 10;
  const Run first = run_of(axis, make_hidden_log(axis, 1));
  const Run other = run_of(axis, make_hidden_log(axis, 2));
  const Conditioning conditioning;
  const Dataset fit =
      make_dataset({first}, conditioning, stated_baseline(nominal_of(axis)), on_all_rows);
  const Dataset unseen =
      make_dataset({other}, conditioning, stated_baseline(nominal_of(axis)), on_all_rows);
  const Context context = make_context(nominal_of(axis), fit);
  const auto terms = memorising_terms();
  const FittedModel plain{{}, fit_bias_corrected(fit, context, {}, {}, 0, 1).coefficients};
  const FittedModel memory{terms, fit_bias_corrected(fit, context, terms, {}, 0, 1).coefficients};
  const auto gain = [&](const Dataset& data) {
    const HeldOut judge(data, context, kSameSession);
    return judge.gain(judge.residual(plain), judge.residual(memory), 1);
  };
  return {gain(fit), gain(unseen)};
}

TEST(HeldOut, LeakageWouldBeNoticed) {
  const Gains gains = gains_of_memory();
  EXPECT_GT(gains.on_itself.ci99.value, 0.02) << "the fitted data flatters";
  EXPECT_LT(gains.on_another.ci99.value, 0) << "other data does not";
}

TEST(HeldOut, AnUnchangedResidualGainsNothing) {
  HiddenAxis axis;
  axis.duration_s = 10;
  const Dataset data = make_dataset({run_of(axis, make_hidden_log(axis, 1))}, {},
                                    stated_baseline(nominal_of(axis)), on_all_rows);
  const Context context = make_context(nominal_of(axis), data);
  const HeldOut judge(data, context, kSameSession);
  const Eigen::VectorXd r =
      judge.residual({{}, fit_bias_corrected(data, context, {}, {}, 0, 1).coefficients});
  const Gain gain = judge.gain(r, r, 1);
  EXPECT_EQ(gain.ci99.low, 0);
  EXPECT_EQ(gain.ci99.high, 0);
}

}  // namespace
}  // namespace towbench::tests
