// What the simulated references add to the residual that is tested. Of n whose encoders stand
// elsewhere under the start it has at most sqrt(1 + 1/n) of the log's own noise; less where both
// make the same errors.
#include <algorithm>
#include <cmath>
#include <vector>

#include <gtest/gtest.h>

#include "study/diagnose/context.h"
#include "study/diagnose/evidence.h"
#include "study/diagnose/gates.h"
#include "tests/study/diagnose/hidden_case.h"

namespace towbench::tests {
namespace {

using namespace harness::diagnose;

bool in_all_rows(Eigen::Index /*row*/, Eigen::Index /*rows*/) {
  return true;
}

double added_by_references(std::uint64_t seed) {
  const HiddenAxis nothing_hidden;
  const std::vector<Run> runs{run_of(nothing_hidden, make_hidden_log(nothing_hidden, seed))};
  const NominalModel model = nominal_of(nothing_hidden);
  const Dataset data =
      make_dataset(runs, choose_conditioning(runs, model), stated_baseline(model), in_all_rows);
  const Evidence e = fit_bias_corrected(data, make_context(model, data), {},
                                        {find_control_law(runs.front())}, kReferenceRounds, seed);
  return e.corrected.norm() / e.residual.norm();
}

TEST(SimulatedReferences, AddAQuarterOfTheLogsNoiseAtMost) {
  std::vector<double> ratios;
  for (std::uint64_t seed = 1; seed <= 5; ++seed) {
    ratios.push_back(added_by_references(seed));
  }
  std::sort(ratios.begin(), ratios.end());
  EXPECT_LT(ratios[2], std::sqrt(1.25));
  EXPECT_GT(ratios[2], 0.9) << "simulated references must not be fitted to the log";
}

}  // namespace
}  // namespace towbench::tests
