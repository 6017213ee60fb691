#include "study/identify/paired_law.h"

#include <Eigen/Core>
#include <algorithm>
#include <cmath>

#include <boost/math/distributions/students_t.hpp>

#include "study/identify/linear_algebra.h"
#include "study/statistics/statistics.h"

namespace towbench::study::identify {
namespace {

constexpr Eigen::Index kUnknown = 3;  // dC, dB, dv
constexpr double kSame = 1e-6;        // a simulated reference's gear is written to so many digits

struct Pairs {
  Eigen::MatrixXd slopes;  // of the law, weighted
  Eigen::VectorXd differences;
  Eigen::VectorXd by_excess;  // slope by S - C
};

// Of one speed, both directions.
struct SpeedPairs {
  double speed = 0;
  double weight = 0;
  double sum = 0;  // of weighted differences
};

std::vector<SpeedPairs> by_speed(const std::vector<SteadyRun>& machine,
                                 const std::vector<SteadyRun>& reference) {
  std::vector<SpeedPairs> speeds;
  for (const auto& one : machine) {
    const double w = std::fabs(one.speed_rad_per_s);
    const auto other = std::find_if(reference.begin(), reference.end(), [&](const SteadyRun& each) {
      return std::fabs(one.speed_rad_per_s - each.speed_rad_per_s) < kSame * w;
    });
    if (other == reference.end()) {
      continue;
    }
    if (speeds.empty() || std::fabs(speeds.back().speed - w) > kSame * w) {
      speeds.push_back({.speed = w});
    }
    const double standard_error = std::hypot(one.standard_error_Nm, other->standard_error_Nm);
    const double weight = 1 / (standard_error * standard_error);
    speeds.back().weight += weight;
    speeds.back().sum += weight * (std::fabs(one.torque_Nm) - std::fabs(other->torque_Nm));
  }
  return speeds;
}

Pairs paired(const FrictionLaw& law, const std::vector<SpeedPairs>& speeds) {
  const auto n = static_cast<Eigen::Index>(speeds.size());
  Pairs pairs{Eigen::MatrixXd(n, kUnknown), Eigen::VectorXd(n), Eigen::VectorXd(n)};
  for (Eigen::Index i = 0; i < n; ++i) {
    const auto& [w, weight, sum] = speeds[static_cast<std::size_t>(i)];
    const double ratio = w / law.stribeck_rad_per_s;
    const double fall = std::exp(-ratio * ratio);
    const double root = std::sqrt(weight);
    pairs.slopes.row(i) << root, root * w,
        root * law.excess_Nm * fall * 2 * ratio * ratio / law.stribeck_rad_per_s;
    pairs.by_excess[i] = root * fall;
    pairs.differences[i] = sum / root;
  }
  return pairs;
}

}  // namespace

LawShift find_law_shift(const FrictionLaw& of_reference, double excess_standard_error_Nm,
                        const std::vector<SteadyRun>& machine,
                        const std::vector<SteadyRun>& reference) {
  constexpr Eigen::Index kFewest = 6;
  constexpr double kAnswer = 0.58;  // 1/sqrt(3)
  LawShift shift;
  const auto pairs = paired(of_reference, by_speed(machine, reference));
  const Eigen::Index n = pairs.differences.size();
  if (n < kFewest) {
    return shift;
  }
  const auto solved = least_squares(pairs.slopes, pairs.differences);
  if (solved.rank < kUnknown) {
    return shift;
  }
  const Eigen::Vector3d found = solved.x;
  const Eigen::Vector3d by_excess =
      excess_standard_error_Nm * least_squares(pairs.slopes, pairs.by_excess).x;
  const auto degrees_of_freedom = static_cast<double>(n - kUnknown);
  const double wider = boost::math::quantile(boost::math::students_t(degrees_of_freedom), 0.975) /
                       statistics::kNormal95;
  const double noise =
      wider * wider * (pairs.differences - pairs.slopes * found).squaredNorm() / degrees_of_freedom;
  const Eigen::Matrix3d covariance = noise * inverse(pairs.slopes.transpose() * pairs.slopes);
  const auto standard_error = [&](Eigen::Index i) {
    return std::hypot(std::sqrt(covariance(i, i)), by_excess[i], kAnswer * found[i]);
  };
  shift.coulomb_Nm = found[0];
  shift.viscous_Nm_s_per_rad = found[1];
  shift.stribeck_rad_per_s = found[2];
  shift.coulomb_standard_error_Nm = standard_error(0);
  shift.viscous_standard_error = standard_error(1);
  shift.stribeck_standard_error = standard_error(2);
  shift.found = true;
  return shift;
}

}  // namespace towbench::study::identify
