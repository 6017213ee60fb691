#include "tests/harness/diagnose/full_strength.h"

#include <algorithm>
#include <cmath>

#include "harness/diagnose/context.h"
#include "harness/diagnose/testability.h"
#include "harness/diagnose/wald.h"
#include "tests/harness/diagnose/hidden_case.h"

namespace towbench::tests {
namespace {

using namespace harness::diagnose;
using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

constexpr int kMostTries = 12;
constexpr double kCloseEnough = 0.03;  // relative
constexpr double kFarthest = 4;        // a try may change the size by this factor

bool everywhere(Index /*row*/, Index /*rows*/) {
  return true;
}

VectorXd input_of(const Dataset& data) {
  return data.stack([](const Signals& s) -> MatrixXd { return s.input_N; });
}

// Sizes at which the effect alone has the wanted strength: some laws are not linear in theirs.
double sized(const HiddenAxis& alone, double wanted, std::uint64_t seed) {
  HiddenAxis axis = alone;
  for (int i = 0; i < kMostTries; ++i) {
    const double strength = times_detectable(axis, make_hidden_log(axis, seed));
    if (std::abs(strength - wanted) < kCloseEnough * wanted) {
      break;
    }
    axis.size *= std::clamp(wanted / std::max(strength, 1e-9), 1 / kFarthest, kFarthest);
  }
  return axis.size;
}

}  // namespace

double times_detectable(const HiddenAxis& axis, const HiddenLog& log) {
  const Run run = run_of(axis, log);
  Run truth = run;
  truth.input_N = Eigen::Map<const VectorXd>(log.lacking_N.data(), run.size());
  const Conditioning conditioning = choose_conditioning({run}, axis.mass_kg);
  const Baseline baseline = stated_baseline(nominal_of(axis));
  const Dataset data = make_dataset({run}, conditioning, baseline, everywhere);
  const VectorXd hidden = input_of(make_dataset({truth}, conditioning, baseline, everywhere));
  const MatrixXd basis = orthonormal(data.stack(base_columns));
  VectorXd visible = projected_off(basis, hidden);
  if (visible.norm() < kLeastLeft * hidden.norm()) {
    visible = hidden;
  }
  const VectorXd unit = visible.normalized();
  const VectorXd noise = projected_off(basis, input_of(data) - hidden);
  const VectorXd scores = unit.cwiseProduct(noise);
  const double error = std::sqrt(hac_covariance(scores, data.starts())(0, 0));
  return visible.norm() / (kDetection * error);
}

HiddenAxis at_strength(HiddenAxis axis, double share, std::uint64_t seed) {
  const auto alone = [&](const std::string& effect) {
    HiddenAxis one = axis;
    one.effect = effect;
    one.second_effect.clear();
    return effect.empty() ? 0.0 : sized(one, share * kFull, seed);
  };
  const double first = alone(axis.effect);
  axis.second_size = alone(axis.second_effect);
  axis.size = first;
  return axis;
}

}  // namespace towbench::tests
