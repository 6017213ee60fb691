#include "study/diagnose/fine_motion.h"

#include "study/diagnose/zero_phase_filter.h"

namespace towbench::harness::diagnose {
namespace {

using Eigen::Index;
using Eigen::VectorXd;

VectorXd joined(const VectorXd& slow, const VectorXd& fast, const Signals& s, const Context& c) {
  const auto below = ZeroPhaseFilter::smooth(c.quiet_Hz, 1 / s.period_s);
  return fast + below.apply(slow - fast);
}

VectorXd commanded_m_per_s2(const Signals& s, const Context& c) {
  VectorXd force_N = s.input_N;
  for (const auto j : {kViscous, kCoulomb, kBias}) {
    force_N -= c.theta[j] * s.base.col(j);
  }
  for (Index i = 0; i < s.size(); ++i) {
    force_N[i] = s.standing[static_cast<std::size_t>(i)] != 0 ? 0 : force_N[i];
  }
  return force_N / c.theta[kMass];
}

// By the trapezoidal rule.
VectorXd integral(const VectorXd& x, double period_s) {
  VectorXd out = VectorXd::Zero(x.size());
  for (Index i = 1; i < x.size(); ++i) {
    out[i] = out[i - 1] + 0.5 * period_s * (x[i] + x[i - 1]);
  }
  return out;
}

}  // namespace

VectorXd fine_acceleration_m_per_s2(const Signals& signals, const Context& context) {
  return context.theta[kMass] > 0 ? joined(signals.acceleration_m_per_s2,
                                           commanded_m_per_s2(signals, context), signals, context)
                                  : signals.acceleration_m_per_s2;
}

FineMotion fine_motion(const Signals& signals, const Context& context) {
  const double period_s = signals.period_s;
  FineMotion fine;
  fine.speed_m_per_s =
      joined(signals.speed_m_per_s,
             integral(fine_acceleration_m_per_s2(signals, context), period_s), signals, context);
  fine.position_m =
      joined(signals.position_m, integral(fine.speed_m_per_s, period_s), signals, context);
  return fine;
}

}  // namespace towbench::harness::diagnose
