#include "study/identify/output_error.h"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <utility>

#include "study/identify/long_run_covariance.h"
#include "study/identify/model_error.h"
#include "study/identify/secant_cost.h"
#include "study/statistics/statistics.h"

namespace towbench::study::identify {
namespace {

enum Index : int {
  kInertia,  // logarithms, of positive quantities
  kViscous,
  kExcess,
  kStribeck,
  kResonance,
  kDamping,
  kShare,  // plain, 0 .. 1
  kDelay,  // in units of 10 us
  kPlace,  // share of the lowest friction that belongs to the place, not to the machine
  kRotor,  // logarithm
  kKnots,  // logarithm of the friction at each knot, then the inner knots' places in cm
};

class Problem {
 public:
  Problem(const TwoMassStart& start, const Recording& data, core::Axis axis, double span_s)
      : start_(start), data_(data), axis_(axis) {
    span_ = std::max<std::size_t>(1, static_cast<std::size_t>(std::lround(span_s / data.period_s)));
    every_ = std::max<std::size_t>(1, static_cast<std::size_t>(std::lround(4e-3 / data.period_s)));
    for (std::size_t k = span_; k < data.rows(); k += every_) {
      rows_.push_back(k);
    }
  }

  [[nodiscard]] int knots() const { return static_cast<int>(start_.knots_m.size()); }
  // The ends of the map are where the data end; only what is between can stand elsewhere.
  [[nodiscard]] int moving() const {
    return start_.knots_known_m > 0 ? std::max(0, knots() - 2) : 0;
  }
  [[nodiscard]] int first_place() const { return kKnots + knots(); }
  [[nodiscard]] int parameters() const { return first_place() + moving(); }
  [[nodiscard]] int data_count() const { return static_cast<int>(rows_.size()); }
  [[nodiscard]] int prior_count() const { return kFixedPriors + moving(); }
  [[nodiscard]] int residual_count() const { return data_count() + prior_count(); }
  [[nodiscard]] Eigen::Index lags() const { return static_cast<Eigen::Index>(4 * span_ / every_); }

  [[nodiscard]] Eigen::VectorXd first() const {
    const auto& a = start_.axis;
    Eigen::VectorXd p(parameters());
    p[kInertia] = std::log(a.inertia_kg_m2);
    p[kViscous] = std::log(a.viscous_friction_Nm_s_per_rad);
    p[kExcess] = std::log(std::max(1e-5, a.friction.breakaway_Nm - a.coulomb_friction_Nm));
    p[kStribeck] = std::log(a.friction.stribeck_speed_rad_per_s);
    p[kResonance] = std::log(a.elasticity.resonance_Hz);
    p[kDamping] = std::log(a.elasticity.damping_ratio);
    p[kShare] = a.friction.carriage_share;
    p[kDelay] = start_.path.delay_s / 1e-5;
    p[kPlace] = first_place_share();
    p[kRotor] = std::log(a.rotor_inertia_kg_m2);
    for (int i = 0; i < knots(); ++i) {
      const auto knot = static_cast<std::size_t>(i);
      p[kKnots + i] =
          std::log(start_.coulomb_Nm.empty() ? a.coulomb_friction_Nm : start_.coulomb_Nm[knot]);
    }
    for (int i = 0; i < moving(); ++i) {
      p[first_place() + i] = start_.knots_m[static_cast<std::size_t>(i) + 1] / kPlaceUnit_m;
    }
    return p;
  }

  // Where friction is the same all along, none of it belongs to the place.
  [[nodiscard]] double first_place_share() const {
    constexpr double kBelieved = 0.1;
    if (start_.coulomb_Nm.empty()) {
      return kBelieved;
    }
    const auto [low, high] =
        std::minmax_element(start_.coulomb_Nm.begin(), start_.coulomb_Nm.end());
    return std::min(kBelieved, 1 - *low / *high);
  }

  [[nodiscard]] emulator::AxisParameters axis_of(const double* p) const {
    auto a = start_.axis;
    a.inertia_kg_m2 = std::exp(p[kInertia]);
    a.rotor_inertia_kg_m2 = std::exp(p[kRotor]);
    a.viscous_friction_Nm_s_per_rad = std::exp(p[kViscous]);
    a.friction.stribeck_speed_rad_per_s = std::exp(p[kStribeck]);
    a.elasticity.resonance_Hz = std::exp(p[kResonance]);
    a.elasticity.damping_ratio = std::exp(p[kDamping]);
    a.friction.carriage_share = p[kShare];
    const auto knots = start_.knots_m.size();
    double lowest = std::exp(p[kKnots]);
    for (std::size_t i = 1; i < knots; ++i) {
      lowest = std::min(lowest, std::exp(p[kKnots + static_cast<int>(i)]));
    }
    lowest *= 1 - p[kPlace];
    a.coulomb_friction_Nm = lowest;
    a.friction.breakaway_Nm = lowest + std::exp(p[kExcess]);
    a.friction.position.position_m.clear();
    a.friction.position.friction_Nm.clear();
    const auto places_m = knots_of(p);
    for (std::size_t i = 0; knots > 1 && i < knots; ++i) {
      (void)a.friction.position.position_m.push_back(places_m[i]);
      (void)a.friction.position.friction_Nm.push_back(std::exp(p[kKnots + static_cast<int>(i)]) -
                                                      lowest);
    }
    return a;
  }
  [[nodiscard]] std::vector<double> knots_of(const double* p) const {
    auto places_m = start_.knots_m;
    for (int i = 0; i < moving(); ++i) {
      places_m[static_cast<std::size_t>(i) + 1] = p[first_place() + i] * kPlaceUnit_m;
    }
    return places_m;
  }
  [[nodiscard]] DrivePath path_of(const double* p) const {
    auto path = start_.path;
    path.delay_s = p[kDelay] * 1e-5;
    return path;
  }

  [[nodiscard]] std::optional<std::vector<double>> simulate(const double* p) const {
    return simulate_counts(axis_of(p), path_of(p), data_, axis_);
  }

  [[nodiscard]] bool residuals(const double* p, double* out) const {
    const auto simulated = simulate(p);
    if (!simulated) {
      return false;
    }
    const auto& counts = data_.axes[axis_].count;
    for (std::size_t i = 0; i < rows_.size(); ++i) {
      const std::size_t k = rows_[i];
      const auto measured = static_cast<double>(counts[k] - counts[k - span_]);
      out[i] = measured - ((*simulated)[k] - (*simulated)[k - span_]);
    }
    priors(p, out + rows_.size());
    return true;
  }

  // In counts: one standard deviation off a prior counts as the noise of a few hundred rows.
  void priors(const double* p, double* out) const {
    const auto guess = first();
    const auto prior = [&](int i, double known) {
      return known > 0 ? kPriorWeight * (p[i] - guess[i]) / known : 0.0;
    };
    out[0] = prior(kStribeck, start_.stribeck_known);
    out[1] = prior(kExcess, start_.excess_known);
    out[2] = prior(kShare, start_.share_known);
    out[3] = prior(kDelay, 3.0);
    out[4] = prior(kPlace, 0.2);
    // No guess but a measurement: with the weight of one row.
    out[5] = prior(kRotor, std::max(start_.rotor_known, kHeld)) / kPriorWeight;
    for (int i = 0; i < moving(); ++i) {
      out[kFixedPriors + i] = prior(first_place() + i, start_.knots_known_m / kPlaceUnit_m);
    }
  }

  [[nodiscard]] double step_of(int i) const {
    const bool share = i == kShare || i == kPlace;
    return share ? 1e-3 : (i == kDelay || i >= first_place() ? 1e-2 : 2e-4);
  }

  // While inertia, friction and swing are still wrong, what shows in small things only would make
  // up for them, and be stuck at the end of its range.
  [[nodiscard]] Bounds swing_only(const Eigen::VectorXd& p) const {
    auto bounds = bounds_around(p);
    for (int i = 0; i < p.size(); ++i) {
      if (i == kExcess || i == kStribeck || i == kShare || i == kDelay || i == kPlace ||
          i == kRotor || i >= first_place()) {
        bounds.low[i] = std::max(bounds.low[i], p[i] - kHeld);
        bounds.high[i] = std::min(bounds.high[i], p[i] + kHeld);
      }
    }
    return bounds;
  }

  [[nodiscard]] Bounds bounds_around(const Eigen::VectorXd& p) const {
    Bounds bounds{.low = p, .high = p};
    const auto bound = [&](int i, double low, double high) {
      bounds.low[i] = low;
      bounds.high[i] = high;
    };
    for (int i = 0; i < first_place(); ++i) {
      const double half_width = i == kViscous || i == kDamping || i == kExcess ? 3.0 : 1.6;
      bound(i, p[i] - half_width, p[i] + half_width);
    }
    bound(kShare, 0.02, 0.98);
    bound(kDelay, 0.0, 9.9);
    bound(kPlace, 0.0, 0.7);
    const double rotor = std::log(start_.axis.rotor_inertia_kg_m2);
    const double half_width = std::max(kHeld, kRotorBound * start_.rotor_known);
    bound(kRotor, rotor - half_width, rotor + half_width);
    // No knot passes another one, whatever its neighbour does.
    for (int i = 0; i < moving(); ++i) {
      const auto knot = static_cast<std::size_t>(i) + 1;
      const auto& x = start_.knots_m;
      bound(first_place() + i, (x[knot] - kNearer * (x[knot] - x[knot - 1])) / kPlaceUnit_m,
            (x[knot] + kNearer * (x[knot + 1] - x[knot])) / kPlaceUnit_m);
    }
    return bounds;
  }

 private:
  static constexpr double kPriorWeight = 10;
  static constexpr double kHeld = 1e-6;
  static constexpr double kRotorBound = 5;  // standard deviations
  static constexpr int kFixedPriors = 6;
  static constexpr double kPlaceUnit_m = 0.01;
  static constexpr double kNearer = 0.4;  // of the way to a neighbour
  const TwoMassStart& start_;
  const Recording& data_;
  core::Axis axis_;
  std::size_t span_ = 1;
  std::size_t every_ = 1;
  std::vector<std::size_t> rows_;
};

// A right model leaves a third of a count; one that is stuck beside a wrong swing leaves tens, and
// one in which break-away and Stribeck's fall have made up for one another a half or more.
constexpr double kStuck_counts = 2;
constexpr double kRight_counts = 0.5;
constexpr double kTakenIn = 3;  // of a structure's error, over the part left; *assumed*, 1.9 seen
constexpr double kRoundings_counts = 0.408;  // of two counts: sqrt(2/12)

// By differences alone the way to the minimum is slower but more robust.
enum class Way { kQuick, kCareful };

SecantCost cost_of(const Problem& problem, Way way) {
  std::vector<double> steps;
  for (int i = 0; i < problem.parameters(); ++i) {
    steps.push_back(problem.step_of(i));
  }
  return {[&problem](const double* p, double* out) { return problem.residuals(p, out); },
          problem.residual_count(), std::move(steps), way == Way::kQuick ? 0.5 : 0.0};
}

double cost_of_rms(const Problem& problem, double counts) {
  return 0.5 * problem.data_count() * counts * counts;
}

TwoMassFit fit_from(const TwoMassStart& start, const Recording& data, core::Axis axis, Way way) {
  TwoMassFit fit;
  // Short spans first: they have no memory of what a wrong guess did a second ago.
  const Problem coarse(start, data, axis, 0.03);
  const Problem fine(start, data, axis, 0.12);
  Eigen::VectorXd p = coarse.first();
  auto first = cost_of(coarse, way);
  auto cost = cost_of(fine, way);
  fit.converged = minimise(
      first, {.bounds = coarse.swing_only(p), .tolerance = 1e-3, .most_rounds = 1}, p, fit.message);
  // What a wrong structure leaves need not be known to a ten-millionth.
  fit.converged = fit.converged && minimise(cost,
                                            {.bounds = fine.bounds_around(p),
                                             .tolerance = 1e-7,
                                             .rough_above = cost_of_rms(fine, kStuck_counts),
                                             .rough_tolerance = 3e-4},
                                            p, fit.message);
  fit.axis = fine.axis_of(p.data());
  fit.path = fine.path_of(p.data());
  if (auto counts = fine.simulate(p.data())) {
    fit.simulated_counts = std::move(*counts);
  }
  const int m = fine.data_count();
  if (!fit.converged) {
    return fit;
  }
  const auto& residual = cost.residual();
  const auto& jacobian = cost.jacobian();
  const Eigen::MatrixXd priors = jacobian.bottomRows(fine.prior_count());
  const Eigen::MatrixXd prior = priors.transpose() * priors;
  const Eigen::MatrixXd covariance =
      sandwich(jacobian.topRows(m), residual.head(m), prior, fine.lags());
  const Eigen::VectorXd bent =
      most_bent(jacobian.topRows(m), residual.head(m), prior, kRoundings_counts);
  const auto error_of = [&](int i) {
    return std::hypot(std::sqrt(std::max(0.0, covariance(i, i))),
                      kTakenIn * bent[i] / statistics::kNormal95);
  };
  fit.inertia_standard_error = fit.axis.inertia_kg_m2 * error_of(kInertia);
  fit.viscous_standard_error = fit.axis.viscous_friction_Nm_s_per_rad * error_of(kViscous);
  fit.resonance_standard_error_Hz = fit.axis.elasticity.resonance_Hz * error_of(kResonance);
  fit.damping_standard_error = fit.axis.elasticity.damping_ratio * error_of(kDamping);
  fit.share_standard_error = error_of(kShare);
  fit.rotor_standard_error = fit.axis.rotor_inertia_kg_m2 * error_of(kRotor);
  fit.common_standard_error_Nm = fit.axis.coulomb_friction_Nm / (1 - p[kPlace]) * error_of(kPlace);
  fit.excess_Nm = std::exp(p[kExcess]);
  fit.excess_standard_error_Nm = fit.excess_Nm * error_of(kExcess);
  fit.stribeck_standard_error = fit.axis.friction.stribeck_speed_rad_per_s * error_of(kStribeck);
  fit.knots_m = fine.knots_of(p.data());
  for (int i = kKnots; i < fine.first_place(); ++i) {
    fit.coulomb_Nm.push_back(std::exp(p[i]));
    fit.coulomb_standard_error_Nm.push_back(std::exp(p[i]) * error_of(i));
  }
  fit.residual_rms_counts = std::sqrt(residual.head(m).squaredNorm() / m);
  return fit;
}

}  // namespace

TwoMassFit fit_two_mass(const TwoMassStart& start, const Recording& data, core::Axis axis) {
  auto best = fit_from(start, data, axis, Way::kQuick);
  const auto leaves_more_than = [&](double counts) {
    return !best.converged || best.residual_rms_counts > counts;
  };
  // Whether it led somewhere else.
  const auto another = [&](const TwoMassStart& from, Way way) {
    constexpr double kSame = 0.01;
    const double left = best.residual_rms_counts;
    auto fit = fit_from(from, data, axis, way);
    const bool same = fit.converged && std::fabs(fit.residual_rms_counts - left) < kSame * left;
    if (fit.converged && leaves_more_than(fit.residual_rms_counts)) {
      best = std::move(fit);
    }
    return !same;
  };
  bool lost = leaves_more_than(kRight_counts);
  if (lost && !leaves_more_than(kStuck_counts)) {
    // From there, with the rise towards standstill where it was first believed.
    auto other = start;
    const auto& friction = start.axis.friction;
    other.axis = best.axis;
    other.knots_m = best.knots_m;
    other.coulomb_Nm = best.coulomb_Nm;
    other.axis.friction.stribeck_speed_rad_per_s = friction.stribeck_speed_rad_per_s;
    other.axis.friction.breakaway_Nm =
        best.axis.coulomb_friction_Nm + friction.breakaway_Nm - start.axis.coulomb_friction_Nm;
    // Twice the same end is no bad luck but what the model leaves.
    lost = another(other, Way::kQuick) && leaves_more_than(kRight_counts);
  }
  if (lost) {
    lost = another(start, Way::kCareful);
  }
  for (const double factor : {0.7, 1.4}) {
    if (lost && leaves_more_than(kStuck_counts)) {
      auto other = start;
      other.axis.elasticity.resonance_Hz *= factor;
      (void)another(other, Way::kCareful);
    }
  }
  return best;
}

}  // namespace towbench::study::identify
