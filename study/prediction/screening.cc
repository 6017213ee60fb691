#include "study/prediction/screening.h"

#include <algorithm>
#include <cmath>

#include "study/prediction/in_parallel.h"
#include "study/prediction/lines.h"

namespace towbench::study::diagnose {
namespace {

using Eigen::Index;
using Eigen::VectorXd;

constexpr double kWholeLeast = 0.3;  // coefficient of what its law fixes at 1
constexpr double kWholeMost = 3;
constexpr double kTurnStep = 0.01;
constexpr double kTurnsTried = 8;  // phases of a run that differ
constexpr double kFarAway = 1.3;   // a mass off by that has been led astray by what is missing

bool is_sought(const Context& c, const Scales& scales) {
  const auto among = [&](const std::vector<double>& lines) {
    return !scales.empty() && std::find(lines.begin(), lines.end(), scales[0]) != lines.end();
  };
  return among(c.lines_per_m) || among(c.lines_Hz);
}

// Zero: a shaft's turn is what it is.
double scale_step(const Context& c, Key key, double value, bool sought) {
  switch (key) {
    case Key::kRipplePerMetre:
    case Key::kReadPerMetre:
    case Key::kOutOfRoundPerMetre:
    case Key::kWheelPerMetre:
      return sought ? 0.01 / c.stroke_m : 0;
    case Key::kWheelDry:  // what a load of its own body rubs is known
      return c.stated.elastic() ? 0 : 0.02 * value;
    case Key::kPeriodicHertz:
      return 0.01 / c.duration_s;
    default:
      return 0.02 * value;
  }
}

// A wave that is stated is found at its frequency, or not at all: the axis has one of a kind.
bool is_at_stated_frequency(const Parameters& terms, const Effect& effect, const Scales& scales) {
  constexpr double kNear = 0.01;
  if (effect.scales.empty() || !wave_of(effect.scales.front())) return true;
  const double stated = terms[effect.scales.front()];
  return stated == 0 || std::abs(scales.front() / stated - 1) < kNear;
}

struct Slot {
  const Effect* effect;
  Scales scales;
  std::vector<double> turns;  // of each run, of what is periodic
  double step;                // of its amplitudes
  Index from;                 // its first column
  Index count;
};

void set_turns(Model& model, const Effect& effect, const std::vector<double>& turns) {
  for (std::size_t run = 0; run < turns.size(); ++run) {
    const int wave = *wave_of(effect.scales.front());
    model.of_run[run].turns[static_cast<std::size_t>(wave)] = turns[run];
  }
}

std::vector<Slot> slots_of(const Frame& frame, const State& s,
                           const std::vector<const Effect*>& excluded) {
  std::vector<Slot> slots;
  Index column = std::ssize(s.free);
  for (const Effect& effect : effects()) {
    if (is_in(frame, s, effect) ||
        std::find(excluded.begin(), excluded.end(), &effect) != excluded.end())
      continue;
    const Index count = std::max<Index>(1, std::ssize(effect.amplitudes));
    const auto add = [&](const Scales& scales, double step) {
      slots.push_back({&effect, scales, {}, step, column, count});
      column += count;
    };
    for (const Scales& scales : effect.grid(frame.context)) {
      if (!is_at_stated_frequency(frame.context.stated.terms, effect, scales)) continue;
      add(scales, effect.step(frame.context));
      if (effect.far_step != nullptr) add(scales, effect.far_step(frame.context));
    }
  }
  in_parallel(slots.size(), [&](std::size_t i) {
    Slot& slot = slots[i];
    const auto& keys = slot.effect->scales;
    if (frame.data->scenes.size() > 1 && !keys.empty() && wave_of(keys.front())) {
      slot.turns = turns_of(*frame.data, s.fitted.e, keys.front(), slot.scales.front());
    }
  });
  return slots;
}

// Of the model's own parameters, and of each candidate.
std::vector<Variation> variations_of(const Frame& frame, const State& s,
                                     const std::vector<Slot>& slots) {
  std::vector<Variation> all = varied(s.fitted.model, s.free);
  for (const Slot& slot : slots) {
    const Effect& effect = *slot.effect;
    Model with = s.fitted.model;
    effect.set(with.parameters, frame.context, slot.scales);
    set_turns(with, effect, slot.turns);
    if (effect.amplitudes.empty()) all.push_back({.model = with});
    for (const Key key : effect.amplitudes) {
      Variation& v = all.emplace_back(Variation{with, slot.step, {}});
      v.model.parameters[key] += v.step;
    }
  }
  return all;
}

Candidate judge(const Blocks& blocks, const Slot& slot, Index p, const VectorXd& before,
                const Parameters& terms) {
  Candidate c;
  c.effect = slot.effect;
  c.scales = slot.scales;
  c.turns = slot.turns;
  const Columns base = up_to(p);
  Columns group;
  for (Index j = 0; j < slot.count; ++j) group.push_back(slot.from + j);
  Columns both = base;
  both.insert(both.end(), group.begin(), group.end());
  c.test = blocks.test(base, group);
  c.b = c.test.b;
  const VectorXd after = blocks.predicted(both);
  c.gain = compare(before, after, 2);
  c.loss = after.sum();
  const bool whole = slot.effect->amplitudes.empty() || slot.effect->whole != 0;
  const double stated =
      slot.effect->amplitudes.empty() ? 0 : terms[slot.effect->amplitudes.front()];
  c.plausible = (!slot.effect->positive || stated + c.b[0] > 0) &&
                (slot.effect->most == 0 || std::abs(stated + c.b[0]) < slot.effect->most) &&
                (!whole || (c.b[0] > kWholeLeast && c.b[0] < kWholeMost)) &&
                c.test.own_share > slot.effect->own && std::isfinite(c.loss);
  return c;
}

constexpr double kSlower = 4;   // than the correction that predicts best
constexpr double kSlowest = 6;  // rad/s
constexpr int kShortFit = 2;    // rounds
constexpr int kLongFit = 12;
constexpr std::size_t kLongFits = 3;

Frame at_slower(Frame frame, const Model& model) {
  frame.bandwidth = std::max(kSlowest, frame.bandwidth / kSlower);
  frame.spans = cut(*frame.data, frame.bandwidth);
  weigh(*frame.data, frame.spans, innovations(*frame.data, model, frame.bandwidth));
  return frame;
}

Fitted fit_scales_too(const Frame& frame, std::vector<FreeParameter> free, const Effect& effect,
                      const Model& from, int rounds) {
  for (const Key key : effect.scales) {
    const double step = scale_step(frame.context, key, from.parameters[key], false);
    free.push_back({.key = key, .step = step, .positive = true});
  }
  return fit_model(*frame.data, frame.context, from, free, frame.bandwidth, frame.spans, rounds);
}

// Of a law whose fit has many minima, a model near the best. At a slower correction they are wider,
// and the stated body is nearer than one that was fitted without the law.
Model best_start(const Frame& given, const State& s, const Effect& effect, const Model& stated) {
  const Frame frame = at_slower(given, s.fitted.model);
  std::vector<Fitted> tried;
  for (const Scales& scales : effect.grid(frame.context)) {
    Model model = with_body_of(stated, s.fitted.model);
    effect.set(model.parameters, frame.context, scales);
    tried.push_back(fit_scales_too(frame, s.free, effect, model, kShortFit));
  }
  const auto by_cost = [](const Fitted& a, const Fitted& b) { return a.cost < b.cost; };
  std::sort(tried.begin(), tried.end(), by_cost);
  tried.resize(std::min(kLongFits, tried.size()));
  for (Fitted& one : tried) one = fit_scales_too(frame, s.free, effect, one.model, kLongFit);
  return std::min_element(tried.begin(), tried.end(), by_cost)->model;
}

}  // namespace

bool is_in(const Frame& frame, const State& s, const Effect& effect) {
  const Parameters& p = s.fitted.model.parameters;
  const Parameters& terms = frame.context.stated.terms;
  const auto used = [&](Key key) { return p[key] != 0 && p[key] != terms[key]; };
  const bool whole = effect.amplitudes.empty();
  return std::any_of(
             effect.amplitudes.begin(), effect.amplitudes.end(),
             [&](Key key) {
               return used(key) &&
                      !(frame.context.stated.elastic() &&
                        (key == Key::kStiffness || key == Key::kDamping || key == Key::kPlay)) &&
                      !(key == Key::kStribeck && s.accepted.empty());
             }) ||
         (whole && used(Key::kMotorMass)) ||
         std::any_of(s.accepted.begin(), s.accepted.end(), [&](const Accepted& a) {
           return a.effect == &effect || a.effect->covers == effect.name ||
                  (!effect.scales.empty() && !a.effect->scales.empty() &&
                   a.effect->scales.front() == effect.scales.front());
         });
}

Screened screen(Frame& frame, const State& s, const std::vector<const Effect*>& excluded) {
  find_lines(*frame.data, s.fitted.e, frame.context);
  const std::vector<Slot> slots = slots_of(frame, s, excluded);
  const std::vector<Variation> variations = variations_of(frame, s, slots);
  const Index p = std::ssize(s.free);
  VectorXd ridge = VectorXd::Zero(std::ssize(variations));
  ridge.head(p) = s.ridge;
  const Blocks blocks(grams_of(*frame.data, s.fitted.e, variations, frame.bandwidth, frame.spans),
                      samples_in(frame.spans, s.fitted.e), ridge);
  const VectorXd before = blocks.predicted(up_to(p));
  std::vector<Candidate> judged(slots.size());
  in_parallel(slots.size(), [&](std::size_t i) {
    judged[i] = judge(blocks, slots[i], p, before, frame.context.stated.terms);
  });
  Screened out;
  out.tried = slots.size();
  for (Candidate& c : judged) {
    c.sought = is_sought(frame.context, c.scales);
    c.tried = static_cast<double>(slots.size()) + (c.sought ? frame.context.searched : 0);
    if (!c.turns.empty()) {
      c.tried *= std::pow(kTurnsTried, static_cast<double>(c.turns.size() - 1));
    }
    const auto same = std::find_if(out.best.begin(), out.best.end(), [&](const Candidate& other) {
      return other.effect == c.effect;
    });
    if (same == out.best.end()) {
      out.best.push_back(c);
    } else if (c.plausible > same->plausible ||
               (c.plausible == same->plausible && c.loss < same->loss)) {
      *same = c;
    }
  }
  std::sort(out.best.begin(), out.best.end(),
            [](const Candidate& a, const Candidate& b) { return a.loss < b.loss; });
  return out;
}

State with(const Frame& frame, const State& s, const Candidate& c, const Model& start) {
  Model model = s.fitted.model;
  Accepted accepted{c.effect, {}, c.sought};
  c.effect->set(model.parameters, frame.context, c.scales);
  if (c.effect->rough) model = best_start(frame, s, *c.effect, start);
  set_turns(model, *c.effect, c.turns);
  for (std::size_t j = 0; j < c.effect->amplitudes.size(); ++j) {
    const Key key = c.effect->amplitudes[j];
    model.parameters[key] += c.effect->whole != 0 ? c.effect->whole : c.b[static_cast<Index>(j)];
    if (c.effect->whole == 0) {
      accepted.free.push_back({.key = key,
                               .step = c.effect->step(frame.context),
                               .positive = c.effect->positive && j == 0});
    }
  }
  for (const Key key : c.effect->scales) {
    const double step = scale_step(frame.context, key, model.parameters[key], c.sought);
    if (step > 0) accepted.free.push_back({.key = key, .step = step, .positive = true});
  }
  for (std::size_t run = 1; run < c.turns.size(); ++run) {
    accepted.free.push_back({.of = FreeParameter::Of::kTurnsOfRun,
                             .key = Key::kCount,
                             .run = run,
                             .wave = *wave_of(c.effect->scales.front()),
                             .step = kTurnStep});
  }
  std::vector<Accepted> all = s.accepted;
  all.push_back(accepted);
  State here = make_state(frame, all, model);
  const double mass_ratio = model.parameters[Key::kMass] / start.parameters[Key::kMass];
  if (mass_ratio > kFarAway || mass_ratio < 1 / kFarAway) {
    State there = make_state(frame, all, with_body_of(start, model));
    if (there.fitted.cost < here.fitted.cost) return there;
  }
  return here;
}

}  // namespace towbench::study::diagnose
