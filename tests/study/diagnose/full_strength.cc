#include "tests/study/diagnose/full_strength.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "study/diagnose/context.h"
#include "study/diagnose/gates.h"
#include "study/diagnose/testability.h"
#include "study/diagnose/wald.h"
#include "tests/study/diagnose/hidden_case.h"

namespace towbench::tests {
namespace {

using namespace harness::diagnose;
using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

constexpr int kMostTries = 12;
constexpr double kCloseEnough = 0.05;  // relative
constexpr double kFarthest = 4;        // a try may change the size by this factor
constexpr double kStride = 1.02;       // from size to size, where strength jumps
// Of a hidden force, rms, off the model's columns; less is the filter's doing.
constexpr double kInSpan = 0.1;
// Of the force's rms; less is not held against a parameter, nor called unexplained.
constexpr double kLeastShare = 0.01;

bool everywhere(Index /*row*/, Index /*rows*/) {
  return true;
}

VectorXd input_of(const Dataset& data) {
  return data.stack([](const Signals& s) -> MatrixXd { return s.input_N; });
}

double rms(const VectorXd& x) {
  return x.norm() / std::sqrt(static_cast<double>(x.size()));
}

// Sizes of one effect that were tried, and the one that came closest to the wanted strength.
class Sizing {
 public:
  Sizing(HiddenAxis alone, double wanted, std::uint64_t seed)
      : axis_(std::move(alone)), best_(axis_.size), wanted_(wanted), seed_(seed) {}

  // Times detectable at this size.
  double strength_at(double size) {
    axis_.size = size;
    const double strength = std::max(1e-9, times_detectable(axis_, make_hidden_log(axis_, seed_)));
    const double off = std::abs(std::log(strength / wanted_));
    if (off < least_off_) {
      least_off_ = off;
      best_ = size;
    }
    return strength;
  }
  [[nodiscard]] bool close() const { return least_off_ <= std::log1p(kCloseEnough); }
  [[nodiscard]] double best() const { return best_; }

 private:
  HiddenAxis axis_;
  double best_;
  double wanted_;
  std::uint64_t seed_;
  double least_off_ = 1e300;
};

// Some laws begin at a threshold, so what is known to be too small and too large is closed in on.
void close_in(Sizing& sizing, double size, double wanted) {
  double too_small = 0;
  double too_large = 1e300;
  for (int i = 0; i < kMostTries && !sizing.close(); ++i) {
    const double strength = sizing.strength_at(size);
    (strength < wanted ? too_small : too_large) = size;
    const double next = size * std::clamp(wanted / strength, 1 / kFarthest, kFarthest);
    const bool between = next > too_small && next < too_large;
    size = between ? next : std::sqrt(too_small * too_large);
  }
}

// Where a body sticks at one size and slips at the next, strength jumps to and fro: what closes in
// may end at a jump across the wanted one, while other sizes have it.
void look_around(Sizing& sizing) {
  const double middle = sizing.best();
  for (double factor = kStride; factor < kFarthest && !sizing.close(); factor *= kStride) {
    sizing.strength_at(middle / factor);
    sizing.strength_at(middle * factor);
  }
}

// A much smaller size that is stronger; 0: there is none. A play that makes the loop hunt drowns in
// noise of its own, and has the wanted strength once more at a hundred times the size.
double stronger_below(const HiddenAxis& alone, double size, double wanted, std::uint64_t seed) {
  constexpr double kStronger = 1.5;
  HiddenAxis axis = alone;
  for (const double smaller : {size / 8, size / 64}) {
    axis.size = smaller;
    if (times_detectable(axis, make_hidden_log(axis, seed)) > kStronger * wanted) {
      return smaller;
    }
  }
  return 0;
}

// The size at which the effect alone has the wanted strength, or comes closest; of several the
// smallest.
double sized(const HiddenAxis& alone, double wanted, std::uint64_t seed) {
  double size = 0;
  for (double start = alone.size; start > 0; start = stronger_below(alone, size, wanted, seed)) {
    Sizing sizing(alone, wanted, seed);
    close_in(sizing, start, wanted);
    look_around(sizing);
    size = sizing.best();
  }
  return size;
}

// Rms of a force that adds so much to the noise that leaving it out costs the least gain.
double least_gaining(const VectorXd& noise) {
  return rms(noise) * std::sqrt(1 / ((1 - kLeastGain) * (1 - kLeastGain)) - 1);
}

}  // namespace

double times_detectable(const HiddenAxis& axis, const HiddenLog& log) {
  const Run run = run_of(axis, log);
  Run truth = run;
  truth.input_N = Eigen::Map<const VectorXd>(log.lacking_N.data(), run.size());
  const Conditioning conditioning = choose_conditioning({run}, nominal_of(axis));
  const Baseline baseline = stated_baseline(nominal_of(axis));
  const Dataset data = make_dataset({run}, conditioning, baseline, everywhere);
  const VectorXd hidden = input_of(make_dataset({truth}, conditioning, baseline, everywhere));
  const MatrixXd basis = orthonormal(data.stack(base_columns));
  const VectorXd off = projected_off(basis, hidden);
  const bool in_span = off.norm() < kInSpan * hidden.norm();
  const VectorXd& visible = in_span ? hidden : off;
  const VectorXd noise = projected_off(basis, input_of(data) - hidden);
  const VectorXd scores = visible.normalized().cwiseProduct(noise);
  const double error_N =
      std::sqrt(hac_covariance(scores, data.starts())(0, 0) / static_cast<double>(noise.size()));
  double detectable_N = std::max(kDetection * error_N, least_gaining(noise));
  if (in_span || axis.effect == "outside") {
    detectable_N = std::max(detectable_N, kLeastShare * rms(input_of(data)));
  }
  return rms(visible) / detectable_N;
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
