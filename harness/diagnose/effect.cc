#include "harness/diagnose/effect.h"

#include "harness/diagnose/elastic_axis.h"

namespace towbench::harness::diagnose {

Eigen::MatrixXd effect_columns(const Effect& effect, const Signals& signals, const Context& context,
                               std::span<const double> scales) {
  if (signals.load == nullptr || effect.acts_on == ActsOn::kMotor) {
    return effect.columns(signals, context, scales);
  }
  Eigen::MatrixXd out = effect.columns(signals.load->motion, context, scales);
  for (Eigen::Index j = 0; j < out.cols(); ++j) {
    out.col(j) = signals.load->through_chain(out.col(j));
  }
  if (effect.acts_on == ActsOn::kBoth) {
    const double share = context.model.chain.load_share;
    out = share * out + (1 - share) * effect.columns(signals, context, scales);
  }
  return out;
}

}  // namespace towbench::harness::diagnose
