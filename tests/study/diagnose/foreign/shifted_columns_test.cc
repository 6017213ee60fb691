// Columns of elastic machines: a load that swings looks like a column that is shifted.
#include <algorithm>
#include <cmath>

#include <gtest/gtest.h>

#include "tests/study/diagnose/foreign/answer.h"
#include "tests/study/diagnose/foreign/drawn_case.h"

namespace towbench::tests::foreign {
namespace {

using study::diagnose::Diagnosis;
using study::diagnose::Request;
using study::diagnose::Run;

Request request_for(std::uint64_t seed) {
  Wish wish;
  wish.kind = "one";
  return request_of(draw_case(wish, seed));
}

bool is_called_shifted(const Diagnosis& d) {
  return std::any_of(d.findings.begin(), d.findings.end(),
                     [](const auto& finding) { return finding.name == "columns_shifted"; });
}

void make_input_late(Run& run, double seconds) {
  const Eigen::VectorXd input_N = run.input_N;
  const auto by = static_cast<Eigen::Index>(std::lround(seconds / run.period_s));
  for (Eigen::Index i = 0; i < run.size(); ++i) {
    run.input_N[i] = input_N[std::max<Eigen::Index>(0, i - by)];
  }
}

// Under a relay the load swings at 4.6 Hz, and the input is a rigid body's a period earlier.
TEST(ShiftedColumns, AreNotThoseOfALoadThatSwings) {
  const Diagnosis d = study::diagnose::diagnose(request_for(79039));
  EXPECT_FALSE(is_called_shifted(d));
  EXPECT_EQ(answer_of(d).words(), "viscous_asymmetry");
}

// The same of a chain that is stated as rigid, and is named.
TEST(ShiftedColumns, AreNotThoseOfASpringThatTheModelLacks) {
  const Diagnosis d = study::diagnose::diagnose(request_for(149044));
  EXPECT_FALSE(is_called_shifted(d));
  EXPECT_EQ(answer_of(d).words(), "chain_elasticity");
}

TEST(ShiftedColumns, OfAnElasticAxisAreRefused) {
  Request request = request_for(95020);
  const auto sine = std::find_if(request.runs.begin(), request.runs.end(),
                                 [](const auto& run) { return run.name == "sine"; });
  ASSERT_NE(sine, request.runs.end());
  make_input_late(*sine, 0.15);
  request.runs = {*sine};
  EXPECT_TRUE(is_called_shifted(study::diagnose::diagnose(request)));
}

}  // namespace
}  // namespace towbench::tests::foreign
