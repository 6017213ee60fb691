#include "study/diagnose/headline.h"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

namespace towbench::harness::diagnose {
namespace {

std::string class_of(const Cause& cause) {
  std::string names = cause.term.effect->name;
  for (const Alternative& alternative : cause.alternatives) {
    names += " or " + alternative.term.effect->name;
  }
  return names;
}

std::string moved_parameters(const Diagnosis& d) {
  std::string out;
  for (const ParameterShift& shift : d.parameters) {
    if (shift.moved) {
      out += fmt::format("{}{} {:.4g} {} (model: {:.4g})", out.empty() ? "" : ", ", shift.name,
                         shift.fitted.value, shift.unit, shift.supplied);
    }
  }
  return out;
}

std::string what_is_wrong(const Diagnosis& d) {
  std::string causes;
  for (const Cause& cause : d.selection.causes) {
    causes += (causes.empty() ? "" : ", ") + class_of(cause);
  }
  const std::string moved = moved_parameters(d);
  if (causes.empty() && moved.empty()) {
    return d.unexplained ? "something is missing in the model that no known effect describes"
                         : "nothing: the model explains this data as well as the data can tell";
  }
  std::string out =
      causes.empty() ? "the structure is right, but off: " + moved : "the model lacks " + causes;
  if (!causes.empty() && !moved.empty()) {
    out += "; and off: " + moved;
  }
  return out;
}

std::string how_sure(const Diagnosis& d) {
  if (d.selection.causes.empty() && !moved_parameters(d).empty()) {
    return fmt::format(
        "each more than 4 standard errors from the model; of {} groups of effects "
        "none passed alpha = {:g} and the held-out test",
        d.selection.tried, kAlpha);
  }
  if (d.selection.causes.empty()) {
    return fmt::format("{} groups of effects tried, none passed alpha = {:g} and the held-out test",
                       d.selection.tried, kAlpha);
  }
  double worst = 0;
  for (const Cause& cause : d.selection.causes) {
    worst = std::max(worst, cause.p_value);
  }
  return fmt::format(
      "each at p < {:.1e} after correction for {} tried, and confirmed on held-out data",
      std::max(worst, 1e-300), d.selection.tried);
}

std::string simulated(const Confirmation& c) {
  return c.position_m.before_rms <= 0
             ? std::string{}
             : fmt::format(
                   "; simulated for {:g} s, the carriage ends {:.3g} instead of {:.3g} mm off",
                   kWindow_s, 1e3 * c.position_m.after_rms, 1e3 * c.position_m.before_rms);
}

std::string what_it_gains(const Diagnosis& d) {
  const bool named = !d.selection.causes.empty();
  if (!named && moved_parameters(d).empty()) {
    return fmt::format(
        "nothing, the model stays; {:.3g} N rms of the held-out force is not explained, {:.2g} % "
        "of "
        "it",
        d.selection.gain.after_rms_N,
        100 * d.selection.gain.after_rms_N / std::max(1e-12, d.heldout_force_rms_N));
  }
  const Gain& gain = named ? d.selection.gain : d.gain_over_supplied;
  return fmt::format(
      "{:.1f} % of the held-out force error, {:.3g} to {:.3g} N rms (95 %: {:.1f} to {:.1f} %){}",
      100 * gain.ci95.value, gain.before_rms_N, gain.after_rms_N, 100 * gain.ci95.low,
      100 * gain.ci95.high, simulated(d.confirmed));
}

// What the fitted runs ask for and the held-out one could not confirm; null: nothing of the kind.
const Rejected* not_borne_out(const Diagnosis& d) {
  constexpr double kMuch = 0.05;  // of the residual, for certain
  const Rejected* most = nullptr;
  for (const Rejected& rejected : d.selection.rejected) {
    const bool much = !d.heldout_same_session && rejected.gain.low > kMuch;
    if (much && (most == nullptr || rejected.gain.value > most->gain.value)) {
      most = &rejected;
    }
  }
  return most;
}

std::string next_step(const Diagnosis& d) {
  for (std::size_t i = 0; i < d.separating.size(); ++i) {
    if (d.separating[i]) {
      return fmt::format("run {}: it tells {} from {}", d.separating[i]->motion.words(),
                         d.selection.causes[i].term.effect->name, d.separating[i]->alternative);
    }
  }
  for (const Cause& cause : d.selection.causes) {
    if (!cause.alternatives.empty()) {
      return fmt::format("no motion in reach tells {} apart; {}", class_of(cause),
                         cause.term.effect->needs);
    }
  }
  if (const Rejected* rejected = not_borne_out(d)) {
    return fmt::format(
        "hold out a run with every speed and stretch: {} would explain much of the "
        "fitted runs, the held-out one does not bear it out",
        rejected->effect);
  }
  if (d.unexplained) {
    return fmt::format("look at unexplained.csv: what is left depends on {}",
                       d.unexplained->coordinate);
  }
  return d.verdicts.front() == "model_adequate"
             ? "nothing; see not_testable for what was out of reach"
             : "use extended_plant.toml";
}

}  // namespace

std::string headline(const Diagnosis& d) {
  if (is_fatal(d.findings)) {
    std::string out = "No diagnosis: the data cannot be used.\n";
    for (const Finding& finding : d.findings) {
      out += fmt::format("  {}: {}\n", finding.name, finding.sentence);
    }
    return out;
  }
  std::string out = fmt::format("What is wrong: {}.\n", what_is_wrong(d));
  out += fmt::format("How sure:      {}.\n", how_sure(d));
  out += fmt::format("What it gains: {}.\n", what_it_gains(d));
  out += d.unexplained
             ? fmt::format("Left over:     {:.3g} N rms along {}, which no effect explains.\n",
                           d.unexplained->rms_N, d.unexplained->coordinate)
             : "Left over:     nothing that the residual tests can see.\n";
  out += fmt::format("What to do:    {}.\n", next_step(d));
  for (const Cause& cause : d.selection.causes) {
    out +=
        fmt::format("  {:<24} {}; alone gains {:.1f} % (99 %: {:.1f} to {:.1f})\n",
                    cause.term.effect->name, cause.term.effect->cause, 100 * cause.gain.ci99.value,
                    100 * cause.gain.ci99.low, 100 * cause.gain.ci99.high);
  }
  for (const Finding& finding : d.findings) {
    out += fmt::format("  note, {}: {}\n", finding.name, finding.sentence);
  }
  return out;
}

}  // namespace towbench::harness::diagnose
