// Linear algebra of a prediction error and its columns, block by block in time.
//
//   e = X b + rest.  Of each block only [X e]'[X e] is kept. Tests, covariances, predictions of a
// part by all others and gains follow from these; a block is longer than the memory of e, so that
// blocks are taken as independent (clusters; Cameron, Miller 2015).
#pragma once

#include <Eigen/Core>
#include <functional>
#include <vector>

#include "study/prediction/predictor.h"

namespace towbench::study::diagnose {

using Columns = std::vector<Eigen::Index>;

// Where the blocks of a data set begin and end.
struct Span {
  Eigen::Index from = 0;
  Eigen::Index to = 0;
  double weight = 1;  // of its squares
};
[[nodiscard]] std::vector<Span> cut(const Data& data, double bandwidth);
// Outlying blocks, beyond kOutlying times the upper quartile of the squares of those that move, are
// weighted as if they were of that size: a push that nobody logged biases a fit little (Huber
// 1964).
inline constexpr double kOutlying = 4;
void weigh(const Data& data, std::vector<Span>& spans, const Eigen::VectorXd& e);
[[nodiscard]] Eigen::VectorXd squares_of(const Eigen::VectorXd& e, const std::vector<Span>& spans);
[[nodiscard]] double weighted_square(const std::vector<Span>& spans, const Eigen::VectorXd& e);
// Of a sum of samples, each: the variance of a sample times how long neighbours are alike (Newey,
// West 1987; here by block).
[[nodiscard]] double long_run_variance(const std::vector<Span>& spans, const Eigen::VectorXd& e);

[[nodiscard]] Eigen::MatrixXd gram_of(const Eigen::Ref<const Eigen::MatrixXd>& rows, double weight);
// Of an error, those of which something can be said, by their weights.
[[nodiscard]] double samples_in(const std::vector<Span>& spans, const Eigen::VectorXd& e);

struct Fit {
  Eigen::VectorXd b;
  Eigen::MatrixXd covariance;  // clustered
};

// Encoder steps rms that rounding alone leaves, with a reserve over 1 / sqrt(12).
inline constexpr double kRounding = 0.35;

// P-value of coefficients that are not zero, of a covariance from so many blocks: Hotelling's F.
[[nodiscard]] double wald(const Eigen::VectorXd& b, const Eigen::MatrixXd& covariance,
                          std::size_t blocks);

struct GroupTest {
  double p_value = 1;
  double statistic = 0;  // b' V^-1 b
  double rms = 0;        // of what the group explains beside the others, a sample
  double own_share = 0;  // of the group's columns, what the others cannot make; the least of them
  Eigen::VectorXd b;     // the group's coefficients beside the others
};

class Blocks {
 public:
  // `ridge`: one a column, the penalty on its square; empty: none. The error is the last column
  // of `all`.
  Blocks(const Eigen::Ref<const Eigen::MatrixXd>& all, const std::vector<Span>& spans,
         Eigen::VectorXd ridge);
  // Of each block its [X e]'[X e]; `samples`: of which something can be said.
  Blocks(std::vector<Eigen::MatrixXd> grams, double samples, Eigen::VectorXd ridge);

  void set_ridge(const Eigen::VectorXd& ridge) { ridge_ = ridge; }

  [[nodiscard]] Fit fit(const Columns& of) const;
  // Of a column's rms, what the others cannot make.
  [[nodiscard]] double own_share(const Columns& others, Eigen::Index column) const;
  // Is `group` needed beside `others`? F test of its clustered covariance.
  [[nodiscard]] GroupTest test(const Columns& others, const Columns& group) const;
  // Squared error of each block, predicted by a fit to the other folds.
  [[nodiscard]] Eigen::VectorXd predicted(const Columns& of) const;
  // Squared error of each block as it is, and with these coefficients.
  [[nodiscard]] Eigen::VectorXd squared(const Columns& of, const Eigen::VectorXd& b) const;
  [[nodiscard]] std::size_t count() const noexcept { return gram_.size(); }

 private:
  [[nodiscard]] Eigen::VectorXd solve(const Eigen::MatrixXd& gram, const Columns& of) const;

  std::vector<Eigen::MatrixXd> gram_;
  Eigen::MatrixXd sum_;
  std::vector<Eigen::MatrixXd> without_;  // a fold
  Eigen::VectorXd ridge_;
  Eigen::Index error_;
  double samples_;  // of which something can be said
};

// Is the error of `better` smaller than that of `worse`? Block by block.
struct Comparison {
  double gain = 0;  // 1 - rms(better) / rms(worse)
  double low = 0;   // its interval, `errors` standard errors either side
  double high = 0;
  double standard_errors = 0;  // of the difference, that it lies above zero
};
[[nodiscard]] Comparison compare(const Eigen::VectorXd& worse, const Eigen::VectorXd& better,
                                 double errors);

}  // namespace towbench::study::diagnose
