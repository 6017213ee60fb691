#include "study/prediction/search.h"

#include <algorithm>
#include <cmath>
#include <optional>

#include "study/prediction/first_fits.h"
#include "study/prediction/weak_causes.h"
#include "study/prediction/whiteness.h"

namespace towbench::study::diagnose {
namespace {

using Eigen::Index;
using Eigen::VectorXd;

constexpr int kRounds = 8;
constexpr std::size_t kShortlist = 3;           // that are fitted, beside the most certain
constexpr std::size_t kFittedOfAShortlist = 2;  // in another's place
constexpr double kStructured = 0.1;             // that innovations predict of themselves
constexpr double kDiverged = 4;                 // times the loss of the model with a cause

class Searcher {
 public:
  Searcher(const Data& data, const Context& context, const Limits& limits)
      : data_(data), limits_(limits) {
    frame_.data = &data;
    frame_.context = context;
  }

  Search run(const Model& start, const GoesOn& goes_on) {
    start_ = start;
    const std::vector<FreeParameter> free =
        base_free_parameters(frame_.context, data_.scenes.size());
    Model model = start;
    for (int round = 0; round < 2; ++round) {
      set_bandwidth(frame_, model);
      model = fit_model(data_, frame_.context, model, free, frame_.bandwidth, frame_.spans, kRounds)
                  .model;
    }
    State now = make_state(frame_, {}, model);
    out_.base = now;
    accept_others(frame_, start_, limits_.least_errors, now);
    accept_structural(frame_, start_, limits_.least_errors, now);
    if (accept_clip(frame_, start_, limits_.least_errors, now)) {
      set_bandwidth(frame_, now.fitted.model);
      now = make_state(frame_, now.accepted, now.fitted.model);
    }
    accept_all(now);
    if (goes_on && !goes_on(ended_with(now))) return std::move(out_);
    revise(now);
    while (drop_the_weak(now)) {
      accept_all(now);
      revise(now);
    }
    out_.base = make_state(frame_, {}, out_.base.fitted.model);  // at the final bandwidth
    ended_with(now);
    return std::move(out_);
  }

 private:
  const Search& ended_with(const State& now) {
    out_.final = now;
    out_.context = frame_.context;
    out_.bandwidth = frame_.bandwidth;
    out_.spans = frame_.spans;
    return out_;
  }

  void accept_all(State& now) {
    do {
      while (now.accepted.size() < limits_.most_causes && accept_one(now)) refit(now);
    } while (now.accepted.size() < limits_.most_causes && accept_at_faster(now));
  }

  void refit(State& now) {
    set_bandwidth(frame_, now.fitted.model);
    now = make_state(frame_, now.accepted, now.fitted.model);
  }

  // What moves the reading alone shows at the bandwidth at which no more than rounding is left.
  bool accept_at_faster(State& now) {
    if (!at_faster(now, [&](State& faster) { return accept_one(faster); })) return false;
    refit(now);
    return true;
  }

  // Fits the model at the faster bandwidth, and keeps both if `is_better_there` accepts them.
  template <typename Accepts>
  bool at_faster(State& now, Accepts is_better_there) {
    Frame before = frame_;
    frame_.followed = kRounding;
    set_bandwidth(frame_, now.fitted.model);
    if (frame_.bandwidth > before.bandwidth) {
      State faster = make_state(frame_, now.accepted, now.fitted.model);
      if (is_better_there(faster)) {
        now = std::move(faster);
        return true;
      }
    }
    frame_ = std::move(before);
    return false;
  }

  bool drop_the_weak(State& now) {
    const double rms_m = now.fitted.e.norm() / std::sqrt(static_cast<double>(data_.samples()));
    out_.structured =
        rms_m > kFollowed * frame_.context.resolution_m &&
        predicted_by_past(data_, now.fitted.e, frame_.spans, frame_.bandwidth) > kStructured;
    auto weak = weak_beside_others(out_.causes);
    if (!weak && out_.structured) {
      const State base = make_state(frame_, {}, out_.base.fitted.model);
      weak = weak_beside_the_rest(out_.causes, compare(base.loss, now.loss, 2).gain);
    }
    if (!weak) return false;
    out_.dropped.push_back(out_.causes[*weak].effect);
    now = without(frame_, now, *weak);
    out_.causes.clear();
    return true;
  }

  std::vector<Candidate> screened(const State& s) {
    Screened found = screen(frame_, s, out_.dropped);
    out_.tried = found.tried;
    return std::move(found.best);
  }

  bool convinces(const Candidate& c) const {
    return c.plausible && is_significant(limits_, c.gain, c.p_value());
  }

  // The best of the shortlist once each of it is fitted; null where none of it is accepted. Of two
  // that predict alike, the more certain.
  const Candidate* best_fitted(const State& s, const std::vector<Candidate>& list, State& best) {
    const Candidate* chosen = nullptr;
    double least_p_value = 1;
    const VectorXd base_e = innovations(data_, out_.base.fitted.model, frame_.bandwidth);
    for (const Candidate* c : shortlist(list)) {
      State other = with(frame_, s, *c, start_);
      const Comparison gain = compare(s.loss, other.loss, 2);
      if (is_weak(frame_, s, other, base_e) ||
          !is_significant(limits_, gain, first_p_value(*c, other, gain)) ||
          !matters(frame_, *c->effect, s, other) || !all_are_worth_naming(frame_, other) ||
          collapses(s, other)) {
        continue;
      }
      const double p_value = fitted_p_value(*c, other, gain);
      const bool first = chosen == nullptr;
      const double ahead = first ? 0 : compare(best.loss, other.loss, 2).standard_errors;
      const bool alike = !first && (std::abs(ahead) < kAlias ||
                                    (p_value < kBeyondDoubt) != (least_p_value < kBeyondDoubt));
      if (first || (alike ? p_value < least_p_value : ahead > 0)) {
        best = std::move(other);
        chosen = c;
        least_p_value = p_value;
      }
    }
    return chosen;
  }

  bool collapses(const State& s, const State& other) const {
    return has_collapsed(frame_.context, other) && !has_collapsed(frame_.context, s);
  }

  // A score test underestimates what is far from linear: the less of its p-value and that of Wald's
  // test once it is fitted.
  double fitted_p_value(const Candidate& c, const State& fitted, const Comparison& gain) const {
    if (c.effect->whole != 0) return first_p_value(c, fitted, gain);
    return std::min(c.p_value(), own_p_value(fitted, fitted.accepted.size() - 1, gain, c.tried));
  }

  // Before its scales are fitted, what is rough is too far off to be tested.
  double first_p_value(const Candidate& c, const State& fitted, const Comparison& gain) const {
    return c.effect->rough ? own_p_value(fitted, fitted.accepted.size() - 1, gain, c.tried)
                           : c.p_value();
  }

  // By the linear prediction, and by certainty. What is rough cannot be tested before its fit: it
  // is tried beside another law of two bodies.
  std::vector<const Candidate*> shortlist(const std::vector<Candidate>& list) const {
    std::vector<const Candidate*> out;
    const Candidate* surest = nullptr;
    for (const Candidate& c : list) {
      if (!convinces(c)) continue;
      if (out.size() < kShortlist) out.push_back(&c);
      if (surest == nullptr || c.p_value() < surest->p_value()) surest = &c;
    }
    const auto add = [&](const Candidate* c) {
      if (c != nullptr && std::find(out.begin(), out.end(), c) == out.end()) out.push_back(c);
    };
    add(surest);
    const bool two_bodies = std::any_of(
        out.begin(), out.end(), [](const Candidate* c) { return c->effect->amplitudes.empty(); });
    for (const Candidate& c : list) {
      if (two_bodies && c.effect->rough) add(&c);
    }
    return out;
  }

  bool accept_one(State& now) {
    std::vector<Candidate> list = screened(now);
    State best;
    const Candidate* chosen = best_fitted(now, list, best);
    out_.refused = list;
    if (chosen == nullptr) return false;
    now = std::move(best);
    drop_the_covered(now);
    return true;
  }

  // What is one of the shapes of the last accepted.
  void drop_the_covered(State& now) const {
    const std::string& covered = now.accepted.back().effect->covers;
    for (std::size_t i = 0; i + 1 < now.accepted.size(); ++i) {
      if (now.accepted[i].effect->name == covered) {
        now = without(frame_, now, i);
        return;
      }
    }
  }

  // Of a cause in the model that has it: Wald's test of its amplitudes.
  double own_p_value(const State& s, std::size_t which, const Comparison& own, double tried) const {
    const Effect& effect = *s.accepted[which].effect;
    if (effect.whole != 0) {
      return own.gain > kFresh && own.standard_errors > limits_.least_errors ? 0 : 1;
    }
    Index at = std::ssize(base_free_parameters(frame_.context, data_.scenes.size()));
    for (std::size_t i = 0; i < which; ++i) at += std::ssize(s.accepted[i].free);
    const Index k = std::ssize(effect.amplitudes);
    VectorXd b(k);
    for (Index j = 0; j < k; ++j) {
      const Key key = effect.amplitudes[static_cast<std::size_t>(j)];
      b[j] = s.fitted.model.parameters[key] - frame_.context.stated.terms[key];
    }
    return std::min(1.0,
                    wald(b, s.linear.covariance.block(at, at, k, k), frame_.spans.size()) * tried);
  }

  // Of the best model without a cause: the others alone, or no cause at all where the others'
  // prediction of one block from the rest diverges.
  VectorXd loss_without(const State& now, const State& rest) const {
    if (rest.loss.sum() > kDiverged * now.loss.sum()) {
      State base = make_state(frame_, {}, out_.base.fitted.model);
      if (base.loss.sum() < rest.loss.sum()) return std::move(base.loss);
    }
    return rest.loss;
  }

  // An accepted cause against the model without it.
  struct Judged {
    State rest;
    std::vector<Candidate> list;  // of what could be in its place
    Comparison own;
    double p_value = 1;
    bool is_accepted = false;
  };

  Judged judge(const State& now, std::size_t i) {
    const Effect* effect = now.accepted[i].effect;
    Judged out;
    out.rest = without(frame_, now, i);
    out.own = compare(loss_without(now, out.rest), now.loss, 2);
    const bool may_be = out.own.gain > limits_.least_gain &&
                        matters(frame_, *effect, out.rest, now) &&
                        is_worth_naming(frame_, *effect, now.fitted.model.parameters);
    if (!may_be) return out;
    out.list = screened(out.rest);
    const auto itself = std::find_if(out.list.begin(), out.list.end(),
                                     [&](const Candidate& c) { return c.effect == effect; });
    out.p_value = std::min(itself == out.list.end() ? 1 : itself->p_value(),
                           own_p_value(now, i, out.own, static_cast<double>(out_.tried)));
    out.is_accepted = is_significant(limits_, out.own, out.p_value);
    return out;
  }

  // The best of the others in a cause's place, if it predicts better; collects what predicts alike.
  std::optional<State> better_in_place(const State& now, const Judged& judged, Cause& cause) const {
    std::size_t fitted = 0;
    for (const Candidate& c : judged.list) {
      // A free shape holds what is structural as one of its forms.
      const bool holds_it = cause.effect->structural && c.effect->flexible;
      const bool rough = c.effect->rough && cause.effect->amplitudes.empty();
      // Without what is structural the model is too far off to convince of anything.
      const bool far_off = cause.effect->structural && c.plausible && c.p_value() < limits_.alpha;
      if (c.effect == cause.effect || holds_it || !(rough || far_off || convinces(c))) continue;
      if (!rough && !far_off && fitted++ >= kFittedOfAShortlist) continue;
      State other = with(frame_, judged.rest, c, start_);
      if (!all_are_worth_naming(frame_, other) || collapses(now, other)) continue;
      if (is_better(frame_, now, other)) return other;
      const double p_value =
          far_off ? fitted_p_value(c, other, compare(judged.rest.loss, other.loss, 2))
                  : c.p_value();
      const bool as_sure = p_value < std::sqrt(judged.p_value);
      if (c.effect->name != cause.effect->name && as_sure && are_alike(frame_, now, other)) {
        cause.alternatives.push_back({c.effect, std::move(other)});
      }
    }
    return std::nullopt;
  }

  // Each accepted cause against none and against every other in its place. What is not accepted at
  // this bandwidth may be at the faster one.
  void revise(State& now) {
    for (std::size_t i = 0; i < now.accepted.size();) {
      const Judged judged = judge(now, i);
      std::optional<State> instead;
      if (judged.is_accepted) {
        Cause cause{.effect = now.accepted[i].effect,
                    .sought = now.accepted[i].sought,
                    .p_value = judged.p_value,
                    .gain = judged.own};
        cause.power = std::max(0.0, judged.rest.loss.sum() - now.loss.sum());
        cause.share = share_of(frame_, cause.power, judged.rest.loss.sum(), now);
        instead = better_in_place(now, judged, cause);
        if (!instead) {
          out_.causes.push_back(std::move(cause));
          ++i;
          continue;
        }
      } else if (frame_.followed <= kRounding || !at_faster(now, [&](const State& faster) {
                   return judge(faster, i).is_accepted;
                 })) {
        instead = judged.rest;
      }
      if (instead) now = *std::move(instead);
      out_.causes.clear();
      i = 0;
    }
  }

  const Data& data_;
  Frame frame_;
  Limits limits_;
  Model start_;
  Search out_;
};

}  // namespace

Search search_causes(const Data& data, const Context& context, const Model& start,
                     const Limits& limits, const GoesOn& goes_on) {
  return Searcher(data, context, limits).run(start, goes_on);
}

}  // namespace towbench::study::diagnose
