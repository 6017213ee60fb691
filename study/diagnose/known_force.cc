#include "study/diagnose/known_force.h"

#include <algorithm>
#include <cmath>

#include "study/prediction/fit.h"
#include "study/statistics/statistics.h"

namespace towbench::study::diagnose {
namespace {

constexpr int kPushRounds = 5;
constexpr int kFitRounds = 8;
constexpr double kRatioStep = 0.02;

}  // namespace

Interval force_ratio(const NominalModel& model, const Run& run, const KnownForce& push) {
  const std::vector<Run> runs{run};
  Data data = make_data(runs, model);
  const Context context = make_context(model, data);
  const auto free = base_free_parameters(context, 1);
  const Eigen::Index last = std::ssize(free);
  // The drive need not make what the push makes.
  Eigen::VectorXd push_N = Eigen::VectorXd::Zero(run.size());
  for (Eigen::Index k = 0; k < run.size(); ++k) {
    const double t = run.period_s * static_cast<double>(k);
    push_N[k] = t >= push.from_s && t < push.to_s ? -push.force_N : 0.0;
  }
  Model start{parameters_of(model), std::vector<OfRun>(1)};
  double ratio = 1;
  double half = 0;
  for (int round = 0; round < kPushRounds; ++round) {
    Eigen::VectorXd& extra_N = data.scenes.front().extra_N;
    extra_N = ratio * push_N;
    const double bandwidth = best_bandwidth(data, context, start, kFollowed);
    const Fitted fitted =
        fit_model(data, context, start, free, bandwidth, cut(data, bandwidth), kFitRounds);
    start = fitted.model;
    Eigen::MatrixXd all(data.samples(), last + 2);
    all.leftCols(last) = columns_of(data, fitted.e, varied(fitted.model, free), bandwidth);
    extra_N = (ratio + kRatioStep) * push_N;
    all.col(last) = (fitted.e - innovations(data, fitted.model, bandwidth)) / kRatioStep;
    all.col(last + 1) = fitted.e;
    const Blocks blocks(all, cut(data, bandwidth), {});
    Columns columns;
    for (Eigen::Index j = 0; j <= last; ++j) columns.push_back(j);
    const Fit fit = blocks.fit(columns);
    ratio += fit.b[last];
    half = statistics::kNormal95 * std::sqrt(std::max(0.0, fit.covariance(last, last)));
  }
  return {ratio, ratio - half, ratio + half};
}

}  // namespace towbench::study::diagnose
