#include "study/diagnose/conditioner.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "study/diagnose/elastic_axis.h"

namespace towbench::harness::diagnose {
namespace {

// Where the load of an elastic axis stands its law is not known, and what is taken for it jumps: a
// filter without ringing, and twice the distance. Its corner is lower for the same band.
constexpr double kGentleCorner = 0.7;
constexpr double kLeastKnown = 0.3;

ZeroPhaseFilter filter_for(const Signals& signals, double cutoff_Hz) {
  const double rate_Hz = 1 / signals.period_s;
  return signals.load != nullptr ? ZeroPhaseFilter::smooth(kGentleCorner * cutoff_Hz, rate_Hz)
                                 : ZeroPhaseFilter::sharp(cutoff_Hz, rate_Hz);
}

// 1 where a row's value is touched by something that is not to be judged: the filter reaches about
// half a period of its cut-off to either side.
std::vector<char> tainted(const Signals& signals, const std::vector<char>& missing,
                          Eigen::Index reach) {
  const Eigen::Index n = signals.size();
  std::vector<char> bad(static_cast<std::size_t>(n), 0);
  for (Eigen::Index i = 0; i < n; ++i) {
    const auto at = static_cast<std::size_t>(i);
    if ((signals.load == nullptr && signals.standing[at] != 0) || missing[at] != 0) {
      const Eigen::Index from = std::max<Eigen::Index>(0, i - reach);
      const Eigen::Index to = std::min(n, i + reach + 1);
      std::fill(bad.begin() + from, bad.begin() + to, char{1});
    }
  }
  return bad;
}

// What was before a log, and comes after, is not known: the reflection that a filter puts there is
// wrong wherever the axis is under way, and a sharp filter rings with it for tenths of a second. A
// weight in time that is the same for all columns changes no law among them; this one rises from
// zero at either end, so that nothing is left to reflect. It begins where the position's own filter
// (of 2.5 times the cut-off) has forgotten its end.
constexpr double kForgotten = 0.4;  // of the border

Eigen::VectorXd faded_at_the_ends(Eigen::Index samples, Eigen::Index border) {
  Eigen::VectorXd weight = Eigen::VectorXd::Ones(samples);
  const double from = kForgotten * static_cast<double>(border);
  for (Eigen::Index i = 0; i < std::min(border, samples / 2); ++i) {
    const double risen = (static_cast<double>(i) - from) / (static_cast<double>(border) - from);
    const double sine = std::sin(std::numbers::pi / 2 * std::max(0.0, risen));
    weight[i] = sine * sine;
    weight[samples - 1 - i] = weight[i];
  }
  return weight;
}

}  // namespace

Conditioner::Conditioner(const Signals& signals, const std::vector<char>& missing,
                         const Conditioning& conditioning, const Wanted& wanted)
    : filter_(filter_for(signals, conditioning.cutoff_Hz)),
      weight_(faded_at_the_ends(signals.size(), filter_.border())) {
  const double rate_Hz = 1 / signals.period_s;
  const auto stride = std::max<Eigen::Index>(
      1, static_cast<Eigen::Index>(0.4 * rate_Hz / conditioning.cutoff_Hz + 1e-9));
  const auto reach = static_cast<Eigen::Index>((signals.load != nullptr ? 1.0 : 0.5) * rate_Hz /
                                               conditioning.cutoff_Hz);
  auto bad = tainted(signals, missing, reach);
  if (signals.load != nullptr) {
    const Eigen::VectorXd known = filter_.apply(signals.load->known);
    for (Eigen::Index i = 0; i < known.size(); ++i) {
      bad[static_cast<std::size_t>(i)] |= static_cast<char>(known[i] < kLeastKnown);
    }
  }
  const Eigen::Index border = filter_.border();
  const Eigen::Index count = std::max<Eigen::Index>(0, (signals.size() - 2 * border) / stride);
  for (Eigen::Index row = 0; row < count; ++row) {
    const Eigen::Index i = border + row * stride;
    if (bad[static_cast<std::size_t>(i)] == 0 && wanted(row, count)) {
      index_.push_back(i);
    }
  }
}

Eigen::VectorXd Conditioner::column(const Eigen::Ref<const Eigen::VectorXd>& raw) const {
  return at_rows(filter_.apply(weight_.cwiseProduct(raw)));
}

Eigen::MatrixXd Conditioner::columns(const Eigen::MatrixXd& raw) const {
  Eigen::MatrixXd out(rows(), raw.cols());
  for (Eigen::Index j = 0; j < raw.cols(); ++j) {
    out.col(j) = column(raw.col(j));
  }
  return out;
}

Eigen::VectorXd Conditioner::at_rows(const Eigen::VectorXd& raw) const {
  Eigen::VectorXd out(rows());
  for (Eigen::Index row = 0; row < rows(); ++row) {
    out[row] = raw[index_[static_cast<std::size_t>(row)]];
  }
  return out;
}

}  // namespace towbench::harness::diagnose
