#include "study/diagnose/diagnosis.h"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "study/diagnose/aside.h"
#include "study/diagnose/model_checks.h"
#include "study/diagnose/momentum.h"
#include "study/diagnose/refutation.h"
#include "study/diagnose/run_checks.h"
#include "study/diagnose/unlike_runs.h"
#include "study/diagnose/unlike_stretches.h"
#include "study/statistics/statistics.h"

namespace towbench::study::diagnose {
namespace {

using Eigen::Index;

void check_data(Request& request, logs::Findings& findings) {
  for (auto* runs : {&request.runs, &request.holdout}) {
    for (Run& run : *runs) {
      check_run(run, request.model, findings);
    }
  }
  if (!is_fatal(findings)) {
    check_against_model(request.runs, request.model, findings);
  }
}

// Mass and friction of a model that states none.
void begin_from_momentum(NominalModel& model, const Momentum& fit) {
  model.mass_kg = fit.mass_kg;
  model.viscous_N_s_per_m = std::max(0.0, fit.viscous_N_s_per_m);
  model.coulomb_N = std::max(0.0, fit.coulomb_N);
  model.bias_N = fit.bias_N;
}

// No data tell it from dry friction where all motion is in one direction.
void take_bias_for_friction(NominalModel& model, double direction) {
  if (direction == 0) return;
  model.coulomb_N = std::max(0.0, model.coulomb_N + direction * model.bias_N);
  model.bias_N = 0;
}

Interval gain_of(const Comparison& c) {
  // From two standard errors either side to 99 %.
  constexpr double kWider = 2.58 / 2;
  return {c.gain, c.gain - kWider * (c.gain - c.low), c.gain + kWider * (c.high - c.gain)};
}

std::vector<Size> sizes_of(const State& state, std::size_t which) {
  const Accepted& accepted = state.accepted[which];
  Index at = std::ssize(state.free);
  for (std::size_t i = state.accepted.size(); i > which; --i) {
    at -= std::ssize(state.accepted[i - 1].free);
  }
  std::vector<Size> sizes;
  const auto add = [&](const std::string& name, Key key) {
    const double value = state.fitted.model.parameters[key];
    const auto free = std::find_if(accepted.free.begin(), accepted.free.end(),
                                   [&](const FreeParameter& f) { return f.key == key; });
    if (free == accepted.free.end()) {
      sizes.push_back({name, {value, value, value}, true});
      return;
    }
    const Index i = at + (free - accepted.free.begin());
    const double half =
        statistics::kNormal95 * std::sqrt(std::max(0.0, state.linear.covariance(i, i)));
    sizes.push_back({name, {value, value - half, value + half}, false});
  };
  const Effect& effect = *accepted.effect;
  for (std::size_t j = 0; j < effect.amplitudes.size(); ++j) {
    add(effect.amplitude_names[j], effect.amplitudes[j]);
  }
  for (std::size_t j = 0; j < effect.scales.size(); ++j) {
    add(effect.scale_names[j], effect.scales[j]);
  }
  return sizes;
}

void name_causes(Diagnosis& d, const Search& search) {
  for (std::size_t i = 0; i < search.causes.size(); ++i) {
    const Cause& cause = search.causes[i];
    NamedCause named{.effect = cause.effect,
                     .sizes = sizes_of(search.final, i),
                     .p_value = cause.p_value,
                     .gain99 = gain_of(cause.gain),
                     .standard_errors = cause.gain.standard_errors};
    for (const Alternative& other : cause.alternatives) {
      named.alternatives.push_back(other.effect->name);
    }
    if (!cause.alternatives.empty()) {
      const Alternative& first = cause.alternatives.front();
      named.separating =
          separate(search, search.final.fitted.model, first.state, first.effect->name);
    }
    d.causes.push_back(std::move(named));
  }
  for (const Effect* effect : search.dropped) d.dropped.push_back(effect->name);
  constexpr double kSpokenFor = 1e-3;
  for (const Candidate& c : search.refused) {
    const bool accepted = std::any_of(search.causes.begin(), search.causes.end(),
                                      [&](const Cause& cause) { return cause.effect == c.effect; });
    if (accepted) continue;
    d.considered.push_back(
        {c.effect->name, c.p_value(), gain_of(c.gain), c.gain.standard_errors, c.plausible});
    if (c.p_value() < kSpokenFor) {
      d.refused.push_back({c.effect->name, c.p_value(), gain_of(c.gain)});
    }
  }
}

// A stated weight that is off by the ratio by which all else is.
void tell_of_gain(Diagnosis& d) {
  const Parameters stated = parameters_of(d.context.stated);
  for (NamedCause& cause : d.causes) {
    if (cause.effect->name != "gravity") continue;
    if (may_be_gain(d.parameters, cause.sizes[0].ci95, cause.sizes[1].ci95, stated)) {
      add_once(cause.alternatives, "amplifier_gain");
    }
  }
}

void conclude(Diagnosis& d) {
  if (std::any_of(d.parameters.begin(), d.parameters.end(),
                  [](const ParameterShift& shift) { return shift.moved; })) {
    d.verdicts.emplace_back("parameters_off");
  }
  if (!d.causes.empty()) {
    d.verdicts.emplace_back("cause_found");
  }
  if (d.unexplained) {
    d.verdicts.emplace_back("unexplained_structure");
  }
  if (d.verdicts.empty()) {
    d.verdicts.emplace_back("model_adequate");
  }
}

std::vector<double> of_runs_m(const Data& data, const Eigen::VectorXd& e) {
  std::vector<double> rms_m;
  for (std::size_t run = 0; run < data.scenes.size(); ++run) {
    const Index n = data.scenes[run].run->size();
    rms_m.push_back(rms_said(e.segment(data.starts[run], n)));
  }
  return rms_m;
}

Aside score_aside(const Request& given, const Data& data, const Search& search) {
  if (given.aside.empty()) return score_stretches(given.stretches, given.runs, search);
  Aside aside;
  aside.others_rms_N = score_within(data, search).after_rms_N;
  for (const Run& run : given.aside) {
    aside.rms_N.push_back(score_on({run}, data, search).after_rms_N);
  }
  return aside;
}

}  // namespace

double NamedCause::size(const std::string& name) const {
  const auto found =
      std::find_if(sizes.begin(), sizes.end(), [&](const Size& s) { return s.name == name; });
  return found == sizes.end() ? 0 : found->ci95.value;
}

namespace {

// Of all runs, as they are.
Diagnosis diagnose_all(const Request& given) {
  Diagnosis d;
  Request request = given;
  leave_out(request.stretches, request.runs);
  const auto tell = [&](const char* what_next) {
    if (request.progress) {
      request.progress(what_next);
    }
  };
  tell("are the columns what they are said to be");
  check_data(request, d.findings);
  if (is_fatal(d.findings)) {
    return d;
  }
  const Momentum momentum = fit_momentum(request.runs, request.model.rotary, 0);
  const Momentum limited = fit_momentum_of_drive(request.runs, request.model.rotary);
  if (!request.model.supplied) {
    begin_from_momentum(request.model, limited);
  }
  Data data = make_data(request.runs, request.model);
  if (!request.model.supplied) take_bias_for_friction(request.model, one_way(data));
  tell("looking for causes");
  Context context = make_context(request.model, data);
  for (const double mass_kg : {momentum.mass_kg, limited.mass_kg}) {
    if (mass_kg <= 0) continue;
    context.mass_least_kg = std::min(context.mass_least_kg, mass_kg / kMassOff);
    context.mass_most_kg = std::max(context.mass_most_kg, mass_kg * kMassOff);
  }
  const Model stated{parameters_of(request.model), std::vector<OfRun>(request.runs.size())};
  Search search = search_causes(data, context, stated, {}, [&](const Search& so_far) {
    d.aside = score_aside(given, data, so_far);
    return is_worth_revising(d.aside);
  });
  if (!is_worth_revising(d.aside)) return d;
  const bool collapses = has_collapsed(search.context, search.final);
  if (collapses) {
    search.causes.clear();
    search.final = search.base;
    d.unexplained = Unexplained{
        .coordinate = kWholeMotion, .share = 1, .rms_N = search.context.input_rms_N, .p_value = 0};
    search.context.stated.supplied = false;  // its parameters are not comparable
  } else {
    tell("whether the causes' laws fit, and what is left");
    d.unexplained = judge_rest(data, search);
    refute_causes(d, request.holdout, data, search);
  }
  d.estimated = !request.model.supplied && !collapses;
  d.context = search.context;
  d.bandwidth = search.bandwidth;
  d.tried = search.tried;
  d.extended = search.final.fitted.model.parameters;
  d.innovations_m =
      search.final.fitted.e.norm() / std::sqrt(static_cast<double>(search.final.fitted.e.size()));
  tell("what would separate causes");
  name_causes(d, search);
  d.parameters = judge_parameters(data, search, !request.aside.empty());
  refute_parameters(d, request.holdout, data, search);
  tell_of_gain(d);
  tell("what the data cannot show");
  d.not_testable = find_not_testable(search);
  d.innovations_of_run_m = of_runs_m(data, search.final.fitted.e);
  d.stated_of_run_m = of_runs_m(data, innovations(data, stated, search.bandwidth));
  d.windows_m = windows_m(data, search);
  d.aside = score_aside(given, data, search);
  tell("scoring, and running both models by themselves");
  d.scored = request.holdout.empty() ? score_within(data, search)
                                     : score_on(request.holdout, data, search);
  d.free_run = run_free(
      request.holdout.empty() ? data : make_data_like(data, request.holdout, request.model),
      search);
  const bool all_is_there = given.stretches.empty();  // pictures show what was put aside
  d.series = make_series(all_is_there ? data : make_data(given.runs, request.model), search);
  conclude(d);
  return d;
}

}  // namespace

Diagnosis diagnose(const Request& request) {
  Diagnosis d = diagnose_all(request);
  if (auto rest = without_unlike_stretches(request, d, diagnose_all)) return *std::move(rest);
  if (auto others = without_unlike_runs(request, d, diagnose_all)) return *std::move(others);
  return d;
}

}  // namespace towbench::study::diagnose
