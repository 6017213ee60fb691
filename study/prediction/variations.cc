#include "study/prediction/variations.h"

#include <algorithm>
#include <memory>

#include "study/prediction/in_parallel.h"

namespace towbench::study::diagnose {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

constexpr std::size_t kAtOnce = 4;  // spans

// The variations of one run, each predicted as far as the others.
class Sweep {
 public:
  Sweep(const Data& data, std::size_t run, const std::vector<Variation>& variations,
        double bandwidth)
      : variations_(variations), innovations_(variations.size()) {
    for (std::size_t i = 0; i < variations.size(); ++i) {
      const Variation& v = variations[i];
      if (v.run.value_or(run) == run) {
        innovations_[i] = std::make_unique<Innovations>(data, run, v.model.in_run(run), bandwidth);
      }
    }
  }

  // Of the samples that follow, as many as `e` has.
  void next(const Eigen::Ref<const VectorXd>& e, Eigen::Ref<MatrixXd> columns) {
    in_parallel(variations_.size(), [&](std::size_t i) {
      auto column = columns.col(static_cast<Index>(i));
      if (innovations_[i] == nullptr) {
        column.setZero();
        return;
      }
      innovations_[i]->next(column);
      column = (e - column) * (1 / variations_[i].step);
    });
  }

 private:
  const std::vector<Variation>& variations_;
  std::vector<std::unique_ptr<Innovations>> innovations_;  // null where nothing varies
};

}  // namespace

MatrixXd columns_of(const Data& data, const VectorXd& e, const std::vector<Variation>& variations,
                    double bandwidth) {
  MatrixXd all(data.samples(), std::ssize(variations));
  for (std::size_t run = 0; run < data.scenes.size(); ++run) {
    const Index from = data.starts[run];
    const Index n = data.starts[run + 1] - from;
    Sweep(data, run, variations, bandwidth).next(e.segment(from, n), all.middleRows(from, n));
  }
  return all;
}

std::vector<MatrixXd> grams_of(const Data& data, const VectorXd& e,
                               const std::vector<Variation>& variations, double bandwidth,
                               const std::vector<Span>& spans) {
  std::vector<MatrixXd> grams(spans.size());
  const Index count = std::ssize(variations);
  std::size_t at = 0;
  for (std::size_t run = 0; run < data.scenes.size(); ++run) {
    Sweep sweep(data, run, variations, bandwidth);
    while (at < spans.size() && spans[at].from < data.starts[run + 1]) {
      std::size_t end = at + 1;
      while (end < std::min(spans.size(), at + kAtOnce) && spans[end].from < data.starts[run + 1]) {
        ++end;
      }
      const Index from = spans[at].from;
      const Index n = spans[end - 1].to - from;
      MatrixXd rows(n, count + 1);
      rows.col(count) = e.segment(from, n);
      sweep.next(rows.col(count), rows.leftCols(count));
      in_parallel(end - at, [&](std::size_t i) {
        const Span& span = spans[at + i];
        grams[at + i] =
            gram_of(rows.middleRows(span.from - from, span.to - span.from), span.weight);
      });
      at = end;
    }
  }
  return grams;
}

}  // namespace towbench::study::diagnose
