#include "study/diagnose/unexplained.h"

#include <algorithm>
#include <cmath>

#include "study/diagnose/motion.h"
#include "study/prediction/whiteness.h"

namespace towbench::study::diagnose {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

constexpr int kBins = 12;
constexpr double kAlpha = 1e-4;
constexpr double kLeastForce = 0.01;  // of the input's rms; less is too small to matter
constexpr double kLeastGain = 0.02;
constexpr double kPastGain = 0.1;  // that the past predicts; a wrong noise model does less

struct Coordinate {
  const char* name;
  VectorXd Motion::*of;
};
constexpr Coordinate kCoordinates[] = {{"position", &Motion::position_m},
                                       {"speed", &Motion::speed_m_per_s},
                                       {"acceleration", &Motion::acceleration_m_per_s2},
                                       {"command", &Motion::input_N},
                                       {"time", &Motion::time_s}};

// Bins that hold as many samples each.
std::vector<double> edges_of(std::vector<double> values) {
  std::sort(values.begin(), values.end());
  std::vector<double> edges;
  for (int i = 0; i <= kBins; ++i) {
    const double edge = values[(values.size() - 1) * static_cast<std::size_t>(i) / kBins];
    if (edges.empty() || edge > edges.back()) edges.push_back(edge);
  }
  return edges;
}

class Seeker {
 public:
  Seeker(Data& data, const Search& search) : data_(data), search_(search) {
    for (const Scene& scene : data.scenes) motions_.push_back(motion_of(*scene.run, kSmooth_s));
    const Parameters& p = search.final.fitted.model.parameters;
    to_force_ = p[Key::kMass] * search.bandwidth * search.bandwidth;
  }

  std::optional<Unexplained> seek() {
    std::optional<Unexplained> best;
    const auto take = [&](std::optional<Unexplained> found) {
      if (found && (!best || found->share > best->share)) best = std::move(found);
    };
    for (const Coordinate& coordinate : kCoordinates) take(along(coordinate));
    if (!best) take(by_its_past());
    return best;
  }

 private:
  std::optional<Unexplained> along(const Coordinate& coordinate) {
    std::vector<double> values;
    for (const Motion& m : motions_) {
      const VectorXd& x = m.*coordinate.of;
      for (Index i = 0; i < x.size(); i += 5) values.push_back(x[i]);
    }
    const std::vector<double> edges = edges_of(std::move(values));
    const Index bins = std::ssize(edges) - 1;
    if (bins < 3) return std::nullopt;
    MatrixXd columns(data_.samples(), bins);
    const State& s = search_.final;
    for (Index bin = 0; bin < bins; ++bin) {
      const double low = edges[static_cast<std::size_t>(bin)];
      const double high = edges[static_cast<std::size_t>(bin) + 1];
      const double step = 0.02 * search_.context.input_rms_N;
      for (std::size_t run = 0; run < motions_.size(); ++run) {
        const VectorXd& x = motions_[run].*coordinate.of;
        data_.scenes[run].extra_N = x.unaryExpr([&](double value) {
          return value >= low && (value < high || bin + 1 == bins) ? step : 0.0;
        });
      }
      columns.col(bin) =
          (s.fitted.e - innovations(data_, s.fitted.model, search_.bandwidth)) / step;
    }
    for (Scene& scene : data_.scenes) scene.extra_N.resize(0);
    Unexplained u;
    u.coordinate = coordinate.name;
    if (!tells(columns, kLeastGain, u)) return std::nullopt;
    for (Index bin = 0; bin < bins; ++bin) {
      const auto i = static_cast<std::size_t>(bin);
      u.at.push_back(0.5 * (edges[i] + edges[i + 1]));
      u.force_N.push_back(b_[bin]);
      u.error_N.push_back(std::sqrt(std::max(0.0, covariance_(bin, bin))));
    }
    return u;
  }

  std::optional<Unexplained> by_its_past() {
    const VectorXd& e = search_.final.fitted.e;
    const double steps = search_.context.resolution_m;
    if (e.norm() / std::sqrt(static_cast<double>(e.size())) < kRounding * steps)
      return std::nullopt;
    Unexplained u;
    u.coordinate = "its own past";
    return tells(lagged(data_, e, search_.bandwidth), kPastGain, u) ? std::optional<Unexplained>(u)
                                                                    : std::nullopt;
  }

  bool tells(const MatrixXd& columns, double least_gain, Unexplained& u) {
    const State& s = search_.final;
    const Index p = s.derivatives.cols();
    const Index k = columns.cols();
    MatrixXd all(data_.samples(), p + k + 1);
    all << s.derivatives, columns, s.fitted.e;
    VectorXd ridge = VectorXd::Zero(p + k);
    ridge.head(p) = s.ridge;
    const Blocks blocks(all, search_.spans, ridge);
    Columns base;
    Columns group;
    for (Index i = 0; i < p; ++i) base.push_back(i);
    for (Index i = p; i < p + k; ++i) group.push_back(i);
    Columns both = base;
    both.insert(both.end(), group.begin(), group.end());
    const GroupTest test = blocks.test(base, group);
    const Comparison gain = compare(blocks.predicted(base), blocks.predicted(both), 2.58);
    const Fit fit = blocks.fit(both);
    b_ = fit.b.tail(k);
    covariance_ = fit.covariance.bottomRightCorner(k, k);
    u.share = gain.gain;
    u.rms_N = to_force_ * test.rms;
    u.p_value = std::min(1.0, test.p_value * (std::ssize(kCoordinates) + 1));
    return u.p_value < kAlpha && gain.gain > least_gain && gain.low > 0 &&
           u.rms_N > kLeastForce * search_.context.input_rms_N;
  }

  Data& data_;
  const Search& search_;
  std::vector<Motion> motions_;
  double to_force_ = 0;
  VectorXd b_;
  MatrixXd covariance_;
};

}  // namespace

std::optional<Unexplained> find_unexplained(Data& data, const Search& search) {
  return Seeker(data, search).seek();
}

}  // namespace towbench::study::diagnose
