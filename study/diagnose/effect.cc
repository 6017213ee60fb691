#include "study/diagnose/effect.h"

#include "study/diagnose/elastic_axis.h"

namespace towbench::harness::diagnose {

ActingColumns acting_columns(const Effect& effect, const Signals& signals, const Context& context,
                             std::span<const double> scales) {
  const auto at = [&](const Signals& s) { return effect.columns(s, context, scales); };
  const auto none = [](const Eigen::MatrixXd& like) {
    return Eigen::MatrixXd::Zero(like.rows(), like.cols());
  };
  if (signals.load != nullptr && effect.acts_on == ActsOn::kBoth) {
    const double share = context.model.chain.load_share;
    return {(1 - share) * at(signals), share * at(signals.load->motion)};
  }
  const bool on_motor = signals.load == nullptr || effect.acts_on == ActsOn::kMotor;
  const Eigen::MatrixXd columns =
      on_motor || effect.acts_on == ActsOn::kChain ? at(signals) : at(signals.load->motion);
  return on_motor ? ActingColumns{columns, none(columns)} : ActingColumns{none(columns), columns};
}

Eigen::MatrixXd effect_columns(const Effect& effect, const Signals& signals, const Context& context,
                               std::span<const double> scales) {
  ActingColumns acting = acting_columns(effect, signals, context, scales);
  if (signals.load == nullptr) {
    return std::move(acting.on_motor);
  }
  for (Eigen::Index j = 0; j < acting.on_load.cols(); ++j) {
    if (!acting.on_motor.col(j).isZero(0)) {
      acting.on_load.col(j) += signals.load->of_motor_force(acting.on_motor.col(j));
    }
  }
  return signals.load->known.asDiagonal() * acting.on_load;
}

}  // namespace towbench::harness::diagnose
