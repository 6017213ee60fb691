#include "study/diagnose/control_law.h"

#include <Eigen/QR>
#include <algorithm>
#include <cmath>

namespace towbench::harness::diagnose {
namespace {

constexpr double kEnoughReproduced = 0.98;

}  // namespace

Eigen::Matrix<double, kLawTerms, 1> LawState::terms(const Run& run, Eigen::Index k,
                                                    double position_m) {
  const double T = run.period_s;
  const Eigen::VectorXd& r = run.reference_m;
  const Eigen::Index last = r.size() - 1;
  const double error = r[k] - position_m;
  if (k == 0) {
    last_error_m = error;
    last_position_m = position_m;
  }
  integral_m_s += error * T;
  const double ahead = r[std::min(k + 1, last)];
  const double behind = r[std::max<Eigen::Index>(k - 1, 0)];
  const double speed = (ahead - behind) / (2 * T);
  const double acceleration = (ahead - 2 * r[k] + behind) / (T * T);
  Eigen::Matrix<double, kLawTerms, 1> out;
  out << error, (error - last_error_m) / T, integral_m_s, speed, acceleration,
      (std::abs(speed) > 1e-6 ? (speed > 0 ? 1.0 : -1.0) : 0.0), (position_m - last_position_m) / T,
      1.0;
  last_error_m = error;
  last_position_m = position_m;
  return out;
}

ControlLaw find_control_law(const Run& run) {
  ControlLaw law;
  if (run.reference_m.size() != run.size()) {
    return law;
  }
  Eigen::MatrixXd terms(run.size(), kLawTerms);
  LawState state;
  for (Eigen::Index k = 0; k < run.size(); ++k) {
    terms.row(k) = state.terms(run, k, run.position_m[k]).transpose();
  }
  const Eigen::VectorXd scale = terms.colwise().norm().transpose().cwiseMax(1e-300);
  const Eigen::MatrixXd scaled = terms.array().rowwise() / scale.transpose().array();
  Eigen::ColPivHouseholderQR<Eigen::MatrixXd> qr(scaled);
  qr.setThreshold(1e-8);
  law.gains = qr.solve(run.input_N).cwiseQuotient(scale);
  const double energy = (run.input_N.array() - run.input_N.mean()).square().sum();
  law.reproduced = 1 - (run.input_N - terms * law.gains).squaredNorm() / std::max(energy, 1e-300);
  law.kind =
      law.reproduced >= kEnoughReproduced ? ControlLaw::Kind::kFitted : ControlLaw::Kind::kTracking;
  return law;
}

}  // namespace towbench::harness::diagnose
