#include "study/diagnose/simulated_reference.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "core/random.h"
#include "study/diagnose/axis_body.h"

namespace towbench::harness::diagnose {
namespace {

using Eigen::VectorXd;

constexpr double kTrackingBandwidth_Hz = 15;
// A fitted law whose simulated reference strays further than this from the log, relative to the
// stroke, is dropped.
constexpr double kMostStray = 0.02;

double quantised(double x, double step, double phase) {
  return step > 0 ? (std::floor(x / step + phase) + 0.5 - phase) * step : x;
}

double rounded(double x, double step) {
  return step > 0 ? std::round(x / step) * step : x;
}

class Simulation {
 public:
  Simulation(const Dataset::Member& member, const Theta& theta, const Baseline& baseline,
             ExtraForce extra, std::uint64_t seed)
      : log_(member.run),
        signals_(member.signals),
        theta_(theta),
        baseline_(baseline),
        extra_(std::move(extra)),
        held_(baseline.model.input_is_held) {
    core::Random random(seed);
    phase_ = random.uniform();
    if (log_.known_N.size() == log_.size()) {
      extra_.on_motor_N += log_.known_N;
    }
    // Of an elastic axis the force that it took; how the load made it so is its own past.
    feed_forward_ = signals_.load != nullptr
                        ? signals_.force_N()
                        : VectorXd(base_columns(signals_) * theta_ + extra_.on_motor_N);
  }

  Run through(const ControlLaw& law) {
    Run reference = log_;
    const Motion start{signals_.position_m[0], signals_.speed_m_per_s[0]};
    AxisBody body(baseline_, theta_, start, start);
    LawState state;
    const auto steps = std::max(1, static_cast<int>(std::ceil(log_.period_s / kLongestStep_s)));
    const double h = log_.period_s / steps;
    for (Eigen::Index k = 0; k < log_.size(); ++k) {
      reference.position_m[k] = quantised(body.motor().position_m, log_.resolution_m, phase_);
      const double demand = law.kind == ControlLaw::Kind::kFitted
                                ? law.gains.dot(state.terms(log_, k, reference.position_m[k]))
                                : tracking(body.motor(), k);
      reference.input_N[k] = rounded(demand, log_.input_step_N);
      const double slope = held_ || k == 0 ? 0.0 : reference.input_N[k] - reference.input_N[k - 1];
      const Eigen::Index next = std::min(k + 1, log_.size() - 1);
      for (int i = 0; i < steps; ++i) {
        const double w = (i + 0.5) / steps;
        const auto between = [&](const VectorXd& x) { return (1 - w) * x[k] + w * x[next]; };
        body.step(reference.input_N[k] + w * slope - between(extra_.on_motor_N),
                  -between(extra_.on_load_N), h);
      }
    }
    return reference;
  }

 private:
  // The model's force along the measured motion, and a spring and damper that holds the simulated
  // reference to it.
  [[nodiscard]] double tracking(const Motion& body, Eigen::Index k) const {
    const double w = 2 * std::numbers::pi * std::min(kTrackingBandwidth_Hz, 0.05 / log_.period_s);
    const double mass = theta_[kMass];
    return feed_forward_[k] + mass * w * w * (signals_.position_m[k] - body.position_m) +
           1.4 * mass * w * (signals_.speed_m_per_s[k] - body.speed_m_per_s);
  }

  const Run& log_;
  const Signals& signals_;
  const Theta& theta_;
  const Baseline& baseline_;
  ExtraForce extra_;
  bool held_;
  VectorXd feed_forward_;
  double phase_ = 0;
};

bool strays(const Run& reference, const Run& log) {
  const double stroke = log.position_m.maxCoeff() - log.position_m.minCoeff();
  const double off = (reference.position_m - log.position_m).cwiseAbs().maxCoeff();
  return !(off < kMostStray * stroke);
}

}  // namespace

SimulatedReference simulate_reference(const Dataset::Member& member, const Theta& theta,
                                      const Baseline& baseline, const ExtraForce& extra,
                                      const ControlLaw& law, std::uint64_t seed) {
  Simulation simulation(member, theta, baseline, extra, seed);
  if (law.kind == ControlLaw::Kind::kFitted) {
    SimulatedReference reference{simulation.through(law), law.kind};
    if (!strays(reference.run, member.run)) {
      return reference;
    }
  }
  return {simulation.through(ControlLaw{}), ControlLaw::Kind::kTracking};
}

}  // namespace towbench::harness::diagnose
