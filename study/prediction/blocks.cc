#include "study/prediction/blocks.h"

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>
#include <utility>

#include <boost/math/distributions/fisher_f.hpp>

#include "study/prediction/in_parallel.h"
#include "study/statistics/statistics.h"

namespace towbench::study::diagnose {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

constexpr Index kFolds = 10;
constexpr double kMemories = 8;  // time constants of the correction in a block, at least
constexpr double kShortest_s = 0.2;
constexpr Index kMostBlocks = 120;
constexpr double kStandstill = 5;    // encoder steps
constexpr double kLeastWay = 0.005;  // of the stroke
constexpr double kNothing = 1e-12;   // of a column's square: depends on the others

// Columns differ in size by their units.
VectorXd solve_scaled(MatrixXd gram, const VectorXd& right) {
  VectorXd scale = gram.diagonal().cwiseMax(1e-300).cwiseSqrt().cwiseInverse();
  gram = scale.asDiagonal() * gram * scale.asDiagonal();
  gram.diagonal().array() += kNothing;
  return scale.asDiagonal() * gram.ldlt().solve(scale.asDiagonal() * right);
}

MatrixXd inverse_scaled(MatrixXd gram) {
  VectorXd scale = gram.diagonal().cwiseMax(1e-300).cwiseSqrt().cwiseInverse();
  gram = scale.asDiagonal() * gram * scale.asDiagonal();
  gram.diagonal().array() += kNothing;
  return scale.asDiagonal() * gram.ldlt().solve(MatrixXd::Identity(gram.rows(), gram.cols())) *
         scale.asDiagonal();
}

// What is left of a block's squared error.
double left_of(const MatrixXd& gram, Index error, const Columns& of, const VectorXd& b) {
  double left = gram(error, error);
  for (std::size_t j = 0; j < of.size(); ++j) {
    double row = -2 * gram(of[j], error);
    for (std::size_t i = 0; i < of.size(); ++i) {
      row += gram(of[i], of[j]) * b[static_cast<Index>(i)];
    }
    left += row * b[static_cast<Index>(j)];
  }
  return std::max(0.0, left);
}

std::vector<MatrixXd> grams_of(const Eigen::Ref<const MatrixXd>& all,
                               const std::vector<Span>& spans) {
  std::vector<MatrixXd> grams(spans.size());
  in_parallel(spans.size(), [&](std::size_t i) {
    grams[i] = gram_of(all.middleRows(spans[i].from, spans[i].to - spans[i].from), spans[i].weight);
  });
  return grams;
}

// The axis, by more than encoder noise at standstill.
bool moves(const Data& data, const Span& span) {
  const auto run = std::upper_bound(data.starts.begin(), data.starts.end(), span.from) - 1;
  const Scene& scene = data.scenes[static_cast<std::size_t>(run - data.starts.begin())];
  const auto x = scene.run->position_m.segment(span.from - *run, span.to - span.from);
  const double way = x.maxCoeff() - x.minCoeff();
  return way > std::max(kStandstill * scene.run->resolution_m,
                        kLeastWay * (scene.stroke_max_m - scene.stroke_min_m));
}

double survival(double f, double k, double rest) {
  if (!(f > 0) || rest < 1) return 1;
  return boost::math::cdf(complement(boost::math::fisher_f(k, rest), f));
}

}  // namespace

double wald(const VectorXd& b, const MatrixXd& covariance, std::size_t blocks) {
  const auto k = static_cast<double>(b.size());
  const auto n = static_cast<double>(blocks);
  const double rest = n - k;
  return survival(b.dot(solve_scaled(covariance, b)) / k * rest / (n - 1), k, rest);
}

std::vector<Span> cut(const Data& data, double bandwidth) {
  double all_s = 0;
  for (const Scene& scene : data.scenes) {
    all_s += scene.run->period_s * static_cast<double>(scene.run->size());
  }
  const double length_s =
      std::max({kMemories / bandwidth, kShortest_s, all_s / static_cast<double>(kMostBlocks)});
  std::vector<Span> spans;
  for (std::size_t i = 0; i < data.scenes.size(); ++i) {
    const Run& run = *data.scenes[i].run;
    const double run_s = run.period_s * static_cast<double>(run.size());
    const auto pieces = std::max<Index>(1, std::lround(run_s / length_s));
    for (Index piece = 0; piece < pieces; ++piece) {
      spans.push_back({data.starts[i] + run.size() * piece / pieces,
                       data.starts[i] + run.size() * (piece + 1) / pieces});
    }
  }
  return spans;
}

void weigh(const Data& data, std::vector<Span>& spans, const VectorXd& e) {
  std::vector<double> squares;
  std::vector<double> moving;
  for (const Span& span : spans) {
    const auto part = e.segment(span.from, span.to - span.from);
    const auto said = static_cast<double>((part.array() != 0).count());
    squares.push_back(said > 0 ? part.squaredNorm() / said : 0);
    if (said > 0 && moves(data, span)) moving.push_back(squares.back());
  }
  const double most = moving.empty() ? 0 : kOutlying * statistics::quantile(moving, 0.75);
  for (std::size_t i = 0; i < spans.size(); ++i) {
    spans[i].weight = squares[i] > most && most > 0 ? most / squares[i] : 1;
  }
}

VectorXd squares_of(const VectorXd& e, const std::vector<Span>& spans) {
  VectorXd squares(std::ssize(spans));
  for (Index i = 0; i < squares.size(); ++i) {
    const Span& span = spans[static_cast<std::size_t>(i)];
    squares[i] = e.segment(span.from, span.to - span.from).squaredNorm();
  }
  return squares;
}

double weighted_square(const std::vector<Span>& spans, const VectorXd& e) {
  double sum = 0;
  for (const Span& span : spans) {
    sum += span.weight * e.segment(span.from, span.to - span.from).squaredNorm();
  }
  return sum;
}

double long_run_variance(const std::vector<Span>& spans, const VectorXd& e) {
  double of_sums = 0;
  double of_samples = 0;
  for (const Span& span : spans) {
    const auto part = e.segment(span.from, span.to - span.from);
    of_sums += span.weight * part.sum() * part.sum();
    of_samples += span.weight * part.squaredNorm();
  }
  return std::max(of_sums, of_samples) / static_cast<double>(e.size());
}

MatrixXd gram_of(const Eigen::Ref<const MatrixXd>& rows, double weight) {
  MatrixXd gram = MatrixXd::Zero(rows.cols(), rows.cols());
  gram.selfadjointView<Eigen::Upper>().rankUpdate(rows.transpose(), weight);
  gram.triangularView<Eigen::StrictlyLower>() = gram.transpose();
  return gram;
}

double samples_in(const std::vector<Span>& spans, const VectorXd& e) {
  double sum = 0;
  for (const Span& span : spans) {
    const auto said = (e.segment(span.from, span.to - span.from).array() != 0).count();
    sum += span.weight * static_cast<double>(said);
  }
  return sum;
}

Blocks::Blocks(const Eigen::Ref<const MatrixXd>& all, const std::vector<Span>& spans,
               VectorXd ridge)
    : Blocks(grams_of(all, spans), samples_in(spans, all.col(all.cols() - 1)), std::move(ridge)) {}

Blocks::Blocks(std::vector<MatrixXd> grams, double samples, VectorXd ridge)
    : gram_(std::move(grams)),
      sum_(MatrixXd::Zero(gram_.front().rows(), gram_.front().cols())),
      ridge_(std::move(ridge)),
      error_(sum_.cols() - 1),
      samples_(samples) {
  if (ridge_.size() == 0) {
    ridge_ = VectorXd::Zero(error_);
  }
  for (const MatrixXd& gram : gram_) sum_ += gram;
  const Index folds = std::min<Index>(kFolds, std::ssize(gram_));
  without_.assign(static_cast<std::size_t>(folds), sum_);
  for (std::size_t i = 0; i < gram_.size(); ++i) {
    without_[i % without_.size()] -= gram_[i];
  }
}

VectorXd Blocks::solve(const MatrixXd& gram, const Columns& of) const {
  MatrixXd a = gram(of, of);
  for (std::size_t j = 0; j < of.size(); ++j) {
    a(static_cast<Index>(j), static_cast<Index>(j)) += ridge_[of[j]];
  }
  return solve_scaled(a, gram(of, error_));
}

Fit Blocks::fit(const Columns& of) const {
  Fit out;
  out.b = solve(sum_, of);
  MatrixXd a = sum_(of, of);
  for (std::size_t j = 0; j < of.size(); ++j) {
    a(static_cast<Index>(j), static_cast<Index>(j)) += ridge_[of[j]];
  }
  MatrixXd meat = MatrixXd::Zero(a.rows(), a.cols());
  for (const MatrixXd& gram : gram_) {
    const VectorXd score = gram(of, error_) - gram(of, of) * out.b;
    meat += score * score.transpose();
  }
  const auto n = static_cast<double>(gram_.size());
  const MatrixXd bread = inverse_scaled(a);
  out.covariance = n / std::max(1.0, n - 1) * bread * meat * bread;
  return out;
}

double Blocks::own_share(const Columns& others, Index column) const {
  const VectorXd by = solve_scaled(sum_(others, others), sum_(others, column));
  const double left = sum_(column, column) - by.dot(sum_(others, column));
  return std::sqrt(std::max(0.0, left) / std::max(1e-300, sum_(column, column)));
}

GroupTest Blocks::test(const Columns& others, const Columns& group) const {
  Columns all = others;
  all.insert(all.end(), group.begin(), group.end());
  const auto k = std::ssize(group);
  GroupTest out;
  // What of each column the others cannot make.
  out.own_share = 1;
  for (const Index g : group) out.own_share = std::min(out.own_share, own_share(others, g));
  const Fit fitted = fit(all);
  const VectorXd b = fitted.b.tail(k);
  const MatrixXd v = fitted.covariance.bottomRightCorner(k, k);
  out.p_value = wald(b, v, gram_.size());
  out.statistic = b.dot(solve_scaled(v, b));
  out.b = b;
  // b' (what the group has of its own) b, by Schur's complement.
  const MatrixXd cross = sum_(others, group);
  VectorXd taken(std::ssize(others));
  taken = solve_scaled(sum_(others, others), cross * b);
  const double square = b.dot(sum_(group, group) * b) - taken.dot(cross * b);
  out.rms = std::sqrt(std::max(0.0, square) / std::max(1.0, samples_));
  return out;
}

VectorXd Blocks::squared(const Columns& of, const VectorXd& b) const {
  VectorXd out(std::ssize(gram_));
  for (std::size_t i = 0; i < gram_.size(); ++i) {
    out[static_cast<Index>(i)] = left_of(gram_[i], error_, of, b);
  }
  return out;
}

VectorXd Blocks::predicted(const Columns& of) const {
  VectorXd out(std::ssize(gram_));
  for (std::size_t fold = 0; fold < without_.size(); ++fold) {
    const VectorXd b = solve(without_[fold], of);
    for (std::size_t i = fold; i < gram_.size(); i += without_.size()) {
      out[static_cast<Index>(i)] = left_of(gram_[i], error_, of, b);
    }
  }
  return out;
}

Comparison compare(const VectorXd& worse, const VectorXd& better, double errors) {
  const auto n = static_cast<double>(worse.size());
  const VectorXd d = worse - better;
  const double mean = d.mean();
  const double spread = std::sqrt((d.array() - mean).square().sum() / std::max(1.0, n * (n - 1)));
  const double before = std::max(1e-300, worse.mean());
  // Per block in rms as well: a few outlying blocks hide how many agree.
  const VectorXd r = worse.cwiseSqrt() - better.cwiseSqrt();
  const double quiet = r.mean() / std::max(1e-300, std::sqrt((r.array() - r.mean()).square().sum() /
                                                             std::max(1.0, n * (n - 1))));
  const auto as_gain = [&](double difference) {
    return 1 - std::sqrt(std::max(0.0, 1 - difference / before));
  };
  return {as_gain(mean), as_gain(mean - errors * spread), as_gain(mean + errors * spread),
          std::max(mean / std::max(1e-300, spread), quiet)};
}

}  // namespace towbench::study::diagnose
