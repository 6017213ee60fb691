#include "study/diagnose/unexplained.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "study/diagnose/free_shapes.h"
#include "study/prediction/acceptance.h"
#include "study/prediction/whiteness.h"

namespace towbench::study::diagnose {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

constexpr double kAlpha = 1e-4;
constexpr double kLeastForce = 0.01;  // of the input's rms; less is too small to matter
constexpr double kLeastGain = 0.02;
constexpr double kPastGain = 0.1;      // that the past predicts; a wrong noise model does less
constexpr double kMisfit = 0.12;       // of the power that a cause predicts, left for a free shape
constexpr double kForceMisfit = 0.05;  // of its force, for a shape that can stand for it
constexpr double kSmallMisfit = 0.2;   // of its force, for a shape too small to matter by itself
constexpr double kSmallShare = 0.12;   // of the error that is left, which it takes away
constexpr double kMuchOfIt = 0.4;      // of the cause's force, where it takes less away
constexpr double kSmallPower = 0.3;    // of the power it predicts, where its force is not known
constexpr double kStandsFor = 0.3;     // of a column of a cause, rms, that a shape cannot make
constexpr double kInPlaceErrors = 3;   // by which a shape in a cause's place predicts better
constexpr double kInPlaceShare = 0.2;  // of the squares beyond the encoder steps
constexpr double kFewErrors = 1.5;     // the same where the share is large: few blocks show no more
constexpr double kLargeShare = 0.3;
constexpr double kAsGood = 1.1;     // of the squares, that a shape in its place may leave
constexpr double kNearlyAll = 0.9;  // of the squares that a cause takes away
// Of a column's own square, that which predicts best: a bin that a fold lacks stays zero.
constexpr double kRidges[] = {1e-4, 1e-3, 1e-2, 1e-1};

// A shape that predicts further.
struct Against {
  struct Cause {
    bool stands_for = false;  // it can make what the cause makes
    double force_N = 0;       // of the cause, rms; zero where it has no amplitude
  };
  Unexplained what;
  bool smooth = false;
  bool matters = false;  // by itself: too small, it only speaks against causes as small
  std::string finer{};   // a coordinate along which another shape takes as much away
  std::vector<Cause> causes;
};

class Seeker {
 public:
  Seeker(Data& data, const Search& search) : data_(data), search_(search) {
    for (const Scene& scene : data.scenes) motions_.push_back(motion_of(*scene.run, kSmooth_s));
    shapes_ = free_shapes(motions_);
    const Parameters& p = search.final.fitted.model.parameters;
    to_force_ = p[Key::kMass] * search.bandwidth * search.bandwidth;
    const State& s = search.final;
    Index most = kLags;
    for (const FreeShape& shape : shapes_) most = std::max(most, shape.columns);
    all_.resize(data.samples(), std::ssize(s.free) + most + 1);
    all_.leftCols(std::ssize(s.free)) =
        columns_of(data, s.fitted.e, varied(s.fitted.model, s.free), search.bandwidth);
    for (const Accepted& a : s.accepted) forces_N_.push_back(force_N(*a.effect));
  }

  // Of the shapes that are certain, that which takes away the most.
  std::optional<Against> best_shape(bool smooth) {
    std::optional<Against> best;
    for (const FreeShape& shape : shapes_) {
      if (shape.smooth != smooth) continue;
      auto found = of(shape);
      if (found && (!best || found->share > best->what.share)) {
        const bool matters = is_a_force(*found);
        best = Against{
            .what = *std::move(found), .smooth = smooth, .matters = matters, .causes = causes_};
      }
    }
    return best;
  }

  // The shape that leaves the least, if that is clearly less than `loss`; of other coordinates than
  // `but`. The motion before need only be as good, where no other shape is better.
  std::optional<Unexplained> better_than(const VectorXd& loss, const std::string& but) {
    std::optional<Unexplained> best;
    std::optional<Unexplained> as_good;
    double least = loss.sum();
    double least_of_all = kAsGood * loss.sum();
    for (const FreeShape& shape : shapes_) {
      if (shape.coordinate == but) continue;
      auto found = of(shape);
      if (!found) continue;
      const double left = loss_.sum();
      if (left < least_of_all) {
        least_of_all = left;
        as_good.reset();
        if (shape.coordinate == kMotionBefore && takes_nearly_all(loss)) as_good = found;
      }
      if (left < least && is_clearly_less(loss)) {
        least = left;
        best = std::move(found);
      }
    }
    return best ? best : as_good;
  }

  bool is_a_force(const Unexplained& u) const {
    return u.rms_N > kLeastForce * search_.context.input_rms_N;
  }

  std::optional<Unexplained> by_its_past() {
    const VectorXd& e = search_.final.fitted.e;
    const double steps = search_.context.resolution_m;
    if (e.norm() / std::sqrt(static_cast<double>(e.size())) < kFollowed * steps) {
      return std::nullopt;
    }
    const MatrixXd past = lagged(data_, e, search_.bandwidth);
    Unexplained u{.coordinate = kOwnPast};
    const bool told = tells(
        past.cols(), [&](Index i) -> VectorXd { return past.col(i); }, u);
    return told && u.share > kPastGain && is_a_force(u) ? std::optional(u) : std::nullopt;
  }

 private:
  bool is_clearly_less(const VectorXd& loss) const {
    const Frame frame{&data_, search_.context, search_.bandwidth, search_.spans};
    const double share = share_of(frame, loss.sum() - loss_.sum(), loss.sum(), search_.final);
    const double errors = compare(loss, loss_, 2).standard_errors;
    return (share >= kInPlaceShare && errors >= kInPlaceErrors) ||
           (share >= kLargeShare && errors >= kFewErrors);
  }
  // Of what the cause takes away.
  bool takes_nearly_all(const VectorXd& loss) const {
    const double without_both = search_.final.loss.sum();
    return without_both - loss_.sum() > kNearlyAll * (without_both - loss.sum());
  }

  std::optional<Unexplained> of(const FreeShape& shape) {
    const State& s = search_.final;
    const double step = 0.02 * search_.context.input_rms_N;
    const auto column = [&](Index i) -> VectorXd {
      for (std::size_t run = 0; run < motions_.size(); ++run) {
        data_.scenes[run].extra_N = step * shape.force(i, motions_[run]);
      }
      return (s.fitted.e - innovations(data_, s.fitted.model, search_.bandwidth)) / step;
    };
    Unexplained u{.coordinate = shape.coordinate};
    const bool told = tells(shape.columns, column, u);
    for (Scene& scene : data_.scenes) scene.extra_N.resize(0);
    if (!told) return std::nullopt;
    if (!shape.at.empty()) {
      u.at = shape.at;
      u.force_N.assign(b_.begin(), b_.end());
      for (Index i = 0; i < shape.columns; ++i) {
        u.error_N.push_back(std::sqrt(std::max(0.0, covariance_(i, i))));
      }
    }
    return u;
  }

  template <typename Column>
  bool tells(Index k, Column column, Unexplained& u) {
    const State& s = search_.final;
    const Index p = std::ssize(s.free);
    all_.col(p + k) = s.fitted.e;
    for (Index i = 0; i < k; ++i) all_.col(p + i) = column(i);
    Blocks blocks(all_.leftCols(p + k + 1), search_.spans, {});
    hold(blocks, p, k);
    Columns base = up_to(p);
    Columns both = up_to(p + k);
    const Columns group(both.begin() + p, both.end());
    const GroupTest test = blocks.test(base, group);
    loss_ = blocks.predicted(both);
    const Comparison gain = compare(blocks.predicted(base), loss_, 2.58);
    find_what_it_stands_for(blocks, base, group);
    const Fit fit = blocks.fit(both);
    b_ = fit.b.tail(k);
    covariance_ = fit.covariance.bottomRightCorner(k, k);
    u.share = gain.gain;
    u.rms_N = to_force_ * test.rms;
    u.p_value = std::min(1.0, test.p_value * static_cast<double>(shapes_.size() + 1));
    return u.p_value < kAlpha &&
           (gain.low > 0 || (u.p_value < kBeyondDoubt && gain.gain > kLeastGain));
  }

  // The shape's columns, as much as predicts best.
  void hold(Blocks& blocks, Index p, Index k) const {
    VectorXd best;
    double least = 0;
    VectorXd ridge(p + k);
    ridge.head(p) = search_.final.ridge;
    for (const double share : kRidges) {
      ridge.tail(k) = share * all_.middleCols(p, k).colwise().squaredNorm();
      blocks.set_ridge(ridge);
      const double left = blocks.predicted(up_to(p + k)).sum();
      if (best.size() > 0 && left >= least) continue;
      least = left;
      best = ridge;
    }
    blocks.set_ridge(best);
  }

  void find_what_it_stands_for(const Blocks& blocks, const Columns& base, const Columns& group) {
    causes_.clear();
    for (const Columns& columns : columns_of_causes()) {
      Columns rest = base;
      std::erase_if(rest, [&](Index j) { return contains(columns, j); });
      Columns with_shape = rest;
      with_shape.insert(with_shape.end(), group.begin(), group.end());
      const bool stands_for = std::all_of(columns.begin(), columns.end(), [&](Index i) {
        return blocks.own_share(with_shape, i) < kStandsFor * blocks.own_share(rest, i);
      });
      causes_.push_back({stands_for, forces_N_[causes_.size()]});
    }
  }
  // What it changes of the prediction: far from zero its columns may say nothing.
  [[nodiscard]] double force_N(const Effect& effect) const {
    if (effect.whole != 0 || effect.amplitudes.empty()) return 0;
    const Parameters stated = parameters_of(search_.context.stated);
    Model rest = search_.final.fitted.model;
    for (const Key key : effect.amplitudes) rest.parameters[key] = stated[key];
    const VectorXd off_m = innovations(data_, rest, search_.bandwidth) - search_.final.fitted.e;
    return to_force_ * off_m.norm() / std::sqrt(static_cast<double>(off_m.size()));
  }
  static bool contains(const Columns& columns, Index i) {
    return std::find(columns.begin(), columns.end(), i) != columns.end();
  }
  // Of the model's own parameters, those of each cause.
  [[nodiscard]] std::vector<Columns> columns_of_causes() const {
    std::vector<Columns> out;
    const auto& accepted = search_.final.accepted;
    Index at = std::ssize(search_.final.free);
    for (const Accepted& a : accepted) at -= std::ssize(a.free);
    for (const Accepted& a : accepted) {
      Columns& columns = out.emplace_back();
      for (Index i = 0; i < std::ssize(a.free); ++i) columns.push_back(at++);
    }
    return out;
  }

  Data& data_;
  const Search& search_;
  std::vector<Motion> motions_;
  std::vector<FreeShape> shapes_;
  double to_force_ = 0;
  std::vector<double> forces_N_;  // of each cause
  MatrixXd all_;                  // by the model's own parameters, by what is tried, and the error
  VectorXd b_;                    // of the shape that was asked last, as what follows
  MatrixXd covariance_;
  VectorXd loss_;
  std::vector<Against::Cause> causes_;
};

// Of the prediction error's power with the causes: what a gain of rms takes away further, and what
// it took away before.
double further_power(double gain) {
  return 1 - (1 - gain) * (1 - gain);
}
double earlier_power(double gain) {
  return 1 / ((1 - gain) * (1 - gain)) - 1;
}

// A finer shape of what a cause is a force of does not speak against it, if it is small.
bool refutes(const Against& shape, std::size_t i, const Cause& cause) {
  const auto [stands_for, force_N] = shape.causes[i];
  if (!shape.finer.empty() && shape.finer == cause.effect->along) return false;
  if (shape.what.coordinate == cause.effect->along) {
    const double finer = cause.effect->finer;
    return finer > 0 && shape.what.rms_N > finer * force_N;
  }
  const double power = further_power(shape.what.share) /
                       std::max(1e-9, earlier_power(std::clamp(cause.gain.gain, 0.0, 0.999)));
  if (!shape.matters) {
    const double least = shape.what.share < kSmallShare ? kMuchOfIt : kSmallMisfit;
    return force_N > 0 ? shape.what.rms_N >= least * force_N
                       : shape.what.share >= kSmallShare && power >= kSmallPower;
  }
  if (shape.smooth && !stands_for) return false;
  const bool takes_its_force = force_N > 0 && shape.what.rms_N >= kForceMisfit * force_N;
  return power >= kMisfit || (stands_for && takes_its_force);
}

// The weakest of those that the shape refutes.
std::optional<std::size_t> refuted_by(const Against& shape, const std::vector<Cause>& causes) {
  std::optional<std::size_t> least;
  for (std::size_t i = 0; i < causes.size(); ++i) {
    const double gain = causes[i].gain.gain;
    if (refutes(shape, i, causes[i]) && (!least || gain < causes[*least].gain.gain)) least = i;
  }
  return least;
}

// Whether it is dropped: not where without it a body of the fit's own invention would be left.
bool drop(const Data& data, Search& search, std::size_t i) {
  const Frame frame{&data, search.context, search.bandwidth, search.spans};
  State rest = without(frame, search.final, i);
  if (has_collapsed(search.context, rest)) return false;
  search.final = std::move(rest);
  search.dropped.push_back(search.causes[i].effect);
  search.causes.erase(search.causes.begin() + static_cast<std::ptrdiff_t>(i));
  return true;
}

// A shape in a cause's place that predicts better: what is there does not follow its law. Drops it.
std::optional<Unexplained> drop_for_a_shape(Data& data, Search& search) {
  const Frame frame{&data, search.context, search.bandwidth, search.spans};
  for (std::size_t i = 0; i < search.causes.size(); ++i) {
    Search rest = search;
    rest.final = without(frame, search.final, i);
    auto better = Seeker(data, rest).better_than(search.final.loss, search.causes[i].effect->along);
    if (better && drop(data, search, i)) return better;
  }
  return std::nullopt;
}

}  // namespace

std::optional<Unexplained> judge_rest(Data& data, Search& search) {
  std::optional<Unexplained> against;
  for (;;) {
    std::optional<Seeker> seeker(std::in_place, data, search);
    std::optional<Unexplained> most;
    std::optional<Unexplained> refuting;
    std::optional<std::size_t> refuted;
    for (const bool smooth : {false, true}) {
      auto shape = seeker->best_shape(smooth);
      if (refuted || !shape) continue;
      if (most && most->share >= shape->what.share) shape->finer = most->coordinate;
      refuted = refuted_by(*shape, search.causes);
      if (refuted) refuting = shape->what;
      if (shape->matters && (!most || shape->what.share > most->share)) most = shape->what;
    }
    if (refuted && drop(data, search, *refuted)) {
      against = refuting;
      continue;
    }
    if (!most || most->share <= kLeastGain) most = seeker->by_its_past();
    seeker.reset();  // its columns are large, and the next ones are as large
    if (auto better = drop_for_a_shape(data, search)) {
      against = std::move(better);
      continue;
    }
    return most ? most : against;
  }
}

}  // namespace towbench::study::diagnose
