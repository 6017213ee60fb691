#include "harness/diagnose/next_experiment.h"

#include <Eigen/QR>
#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

#include <fmt/format.h>

#include "harness/diagnose/wald.h"

namespace towbench::harness::diagnose {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

constexpr double kTwiceAsGood = 1.5;
constexpr double kDuration_s = 12;
constexpr double kRate_Hz = 500;

struct Motion {
  std::string words;
  VectorXd position_m;
};

// To and fro between two points, speed trapezoids of one speed and one acceleration.
Motion trapezoids(double centre, double amplitude, double speed, double acceleration) {
  Motion motion{fmt::format("to and fro over {:.3g} m at {:.3g} m/s, {:.3g} m/s2", 2 * amplitude,
                            speed, acceleration),
                VectorXd(static_cast<Index>(kDuration_s * kRate_Hz))};
  double x = centre - amplitude;
  double v = 0;
  double target = 1;
  for (double& out : motion.position_m) {
    const double to_go = centre + target * amplitude - x;
    const double stop = v * v / (2 * acceleration);
    const double wish = std::abs(to_go) <= stop || to_go * target <= 0 ? 0.0 : target * speed;
    v += std::clamp(wish - v, -acceleration / kRate_Hz, acceleration / kRate_Hz);
    x += v / kRate_Hz;
    if (std::abs(v) < 1e-9 && wish == 0) {
      target = -target;
    }
    out = x;
  }
  return motion;
}

Motion sine(double centre, double amplitude, double frequency_Hz) {
  Motion motion{fmt::format("a sine of {:.3g} m at {:.3g} Hz", amplitude, frequency_Hz),
                VectorXd(static_cast<Index>(kDuration_s * kRate_Hz))};
  for (Index i = 0; i < motion.position_m.size(); ++i) {
    motion.position_m[i] = centre + amplitude * std::sin(2 * std::numbers::pi * frequency_Hz *
                                                         static_cast<double>(i) / kRate_Hz);
  }
  return motion;
}

std::vector<Motion> menu(const Context& c, double top_acceleration) {
  const double centre = 0.5 * (c.stroke_min_m + c.stroke_max_m);
  const double half = 0.5 * (c.stroke_max_m - c.stroke_min_m);
  std::vector<Motion> motions;
  for (const double share : {0.03, 0.1, 0.3, 1.0}) {
    for (const double hurry : {0.1, 1.0}) {
      const double speed = share * c.top_speed_m_per_s;
      const double amplitude = std::min(half, speed * 1.5);
      motions.push_back(trapezoids(centre, amplitude, speed, hurry * top_acceleration));
    }
  }
  for (const double frequency : {0.3, 1.0, 3.0, 8.0}) {
    const double w = 2 * std::numbers::pi * frequency;
    motions.push_back(sine(
        centre, std::min({half, c.top_speed_m_per_s / w, top_acceleration / (w * w)}), frequency));
  }
  return motions;
}

// Rms of the cause's force that base columns and rival cannot make.
double left_of(const MatrixXd& base, const MatrixXd& cause, const VectorXd& beta,
               const MatrixXd& rival) {
  MatrixXd all(base.rows(), base.cols() + rival.cols());
  all << base, rival;
  const VectorXd force = cause * beta;
  return projected_off(orthonormal(all), force).norm() /
         std::sqrt(static_cast<double>(base.rows()));
}

double separation(const Dataset& data, const Context& context, const Cause& cause,
                  const Rival& rival) {
  const auto columns = [&](const Term& term) {
    return data.stack(
        [&](const Signals& s) { return effect_columns(*term.effect, s, context, term.scales); });
  };
  return left_of(data.stack(base_columns), columns(cause.term), cause.beta, columns(rival.term));
}

Dataset virtual_data(const Motion& motion, const Context& c, const Conditioning& conditioning,
                     Baseline baseline) {
  baseline.model.input_is_held = false;
  Run run;
  run.period_s = 1 / kRate_Hz;
  run.position_m = motion.position_m;
  run.input_N = VectorXd::Zero(motion.position_m.size());
  run.missing.assign(static_cast<std::size_t>(run.size()), 0);
  const Signals moved = make_signals(run, conditioning, baseline);
  run.input_N = c.model_force_N(moved);
  return make_dataset({run}, conditioning, baseline, [](Index, Index) { return true; });
}

}  // namespace

std::optional<NextExperiment> separate(const Dataset& data, const Context& context,
                                       const Cause& cause, const Rival& rival) {
  NextExperiment best{{}, rival.term.effect->name, 0, separation(data, context, cause, rival)};
  double top_acceleration = 0;
  for (const auto& member : data.members) {
    top_acceleration =
        std::max(top_acceleration, std::sqrt(member.signals.acceleration_m_per_s2.squaredNorm() /
                                             static_cast<double>(member.signals.size())));
  }
  const Conditioning conditioning{std::min(40.0, data.conditioning.cutoff_Hz),
                                  std::min(100.0, data.conditioning.smoothing_Hz)};
  for (const Motion& motion : menu(context, 3 * top_acceleration)) {
    const Dataset made = virtual_data(motion, context, conditioning, data.baseline);
    if (made.rows() < 200) {
      continue;
    }
    const double left = separation(made, context, cause, rival);
    if (left > best.separation_N) {
      best.separation_N = left;
      best.motion = motion.words;
    }
  }
  const bool helps = best.separation_N > kTwiceAsGood * best.in_this_data_N;
  return helps ? std::optional<NextExperiment>(best) : std::nullopt;
}

}  // namespace towbench::harness::diagnose
