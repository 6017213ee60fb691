#include "study/prediction/whiteness.h"

#include <algorithm>
#include <cmath>

namespace towbench::study::diagnose {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

MatrixXd lagged(const Data& data, const VectorXd& e, double bandwidth) {
  MatrixXd columns = MatrixXd::Zero(e.size(), kLags);
  for (std::size_t run = 0; run < data.scenes.size(); ++run) {
    const double period = data.scenes[run].run->period_s;
    const auto lag = std::max<Index>(1, std::lround(0.5 / (bandwidth * period)));
    const Index from = data.starts[run];
    const Index n = data.starts[run + 1] - from;
    for (Index j = 1; j <= kLags && j * lag < n; ++j) {
      columns.col(j - 1).segment(from + j * lag, n - j * lag) = e.segment(from, n - j * lag);
    }
  }
  return columns;
}

double predicted_by_past(const Data& data, const VectorXd& e, const std::vector<Span>& spans,
                         double bandwidth) {
  MatrixXd all(e.size(), kLags + 1);
  all << lagged(data, e, bandwidth), e;
  const Blocks blocks(all, spans, {});
  Columns past;
  for (Index i = 0; i < kLags; ++i) past.push_back(i);
  return compare(blocks.squared({}, VectorXd(0)), blocks.predicted(past), 2).gain;
}

}  // namespace towbench::study::diagnose
