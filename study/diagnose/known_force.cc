#include "study/diagnose/known_force.h"

#include <algorithm>
#include <cmath>

#include "study/diagnose/dataset.h"
#include "study/diagnose/known_terms.h"
#include "study/diagnose/wald.h"

namespace towbench::harness::diagnose {
namespace {

// Force that the motor, or the load's law, need not make while the push helps.
Eigen::MatrixXd spared_N(const Signals& s, const KnownForce& push) {
  const auto on = (s.time_s.array() >= push.from_s && s.time_s.array() < push.to_s).cast<double>();
  const Eigen::VectorXd spared = -push.force_N * on;
  return spared;
}

}  // namespace

Interval force_ratio(const NominalModel& model, const Run& run, const KnownForce& push) {
  const Baseline baseline = stated_baseline(model);
  std::vector<Run> runs{run};
  const Conditioning conditioning = choose_conditioning(runs, model);
  take_off_known_terms(runs, baseline, conditioning);
  const Dataset data =
      make_dataset(runs, conditioning, baseline, [](Eigen::Index, Eigen::Index) { return true; });
  const WaldTest test = wald_test(
      orthonormal(data.stack(base_columns)),
      data.stack([&](const Signals& s) { return spared_N(s, push); }),
      data.stack([](const Signals& s) -> Eigen::MatrixXd { return s.input_N; }), data.starts());
  const double half = 1.96 * std::sqrt(std::max(0.0, test.covariance(0, 0)));
  return {test.beta[0], test.beta[0] - half, test.beta[0] + half};
}

}  // namespace towbench::harness::diagnose
