#include "study/diagnose/next_experiment.h"

#include <Eigen/QR>
#include <algorithm>
#include <cmath>

#include "study/diagnose/elastic_axis.h"
#include "study/diagnose/wald.h"

namespace towbench::harness::diagnose {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

constexpr double kTwiceAsGood = 1.5;
constexpr double kDuration_s = 12;
constexpr double kRate_Hz = 500;

// Rms of the cause's force that base columns and alternative cannot make.
double left_of(const MatrixXd& base, const MatrixXd& cause, const VectorXd& beta,
               const MatrixXd& alternative) {
  MatrixXd all(base.rows(), base.cols() + alternative.cols());
  all << base, alternative;
  const VectorXd force = cause * beta;
  return projected_off(orthonormal(all), force).norm() /
         std::sqrt(static_cast<double>(base.rows()));
}

double separation(const Dataset& data, const Context& context, const Cause& cause,
                  const Alternative& alternative) {
  const auto columns = [&](const Term& term) {
    return data.stack(
        [&](const Signals& s) { return effect_columns(*term.effect, s, context, term.scales); });
  };
  return left_of(data.stack(base_columns), columns(cause.term), cause.beta,
                 columns(alternative.term));
}

Dataset virtual_data(const TrialMotion& motion, const Context& c, const Conditioning& conditioning,
                     Baseline baseline) {
  baseline.model.input_is_held = false;
  Run run;
  run.period_s = 1 / kRate_Hz;
  run.position_m = motion.positions_m(kDuration_s, run.period_s);
  run.input_N = VectorXd::Zero(run.size());
  run.missing.assign(static_cast<std::size_t>(run.size()), 0);
  const Signals moved = make_signals(run, conditioning, baseline);
  run.input_N =
      baseline.model.elastic() ? force_for_motion_N(moved, baseline) : c.model_force_N(moved);
  return make_dataset({run}, conditioning, baseline, [](Index, Index) { return true; });
}

}  // namespace

std::optional<NextExperiment> separate(const Dataset& data, const Context& context,
                                       const Cause& cause, const Alternative& alternative) {
  NextExperiment best{
      {}, alternative.term.effect->name, 0, separation(data, context, cause, alternative)};
  double top_acceleration = 0;
  for (const auto& member : data.members) {
    top_acceleration =
        std::max(top_acceleration, std::sqrt(member.signals.acceleration_m_per_s2.squaredNorm() /
                                             static_cast<double>(member.signals.size())));
  }
  const Conditioning conditioning{std::min(40.0, data.conditioning.cutoff_Hz),
                                  std::min(100.0, data.conditioning.smoothing_Hz)};
  for (const TrialMotion& motion : motion_menu(context, 3 * top_acceleration)) {
    const Dataset made = virtual_data(motion, context, conditioning, data.baseline);
    if (made.rows() < 200) {
      continue;
    }
    const double left = separation(made, context, cause, alternative);
    if (left > best.separation_N) {
      best.separation_N = left;
      best.motion = motion;
    }
  }
  const bool helps = best.separation_N > kTwiceAsGood * best.in_this_data_N;
  return helps ? std::optional<NextExperiment>(best) : std::nullopt;
}

}  // namespace towbench::harness::diagnose
