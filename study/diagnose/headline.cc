#include "study/diagnose/headline.h"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "study/prediction/units.h"

namespace towbench::study::diagnose {
namespace {

std::string class_of(const NamedCause& cause) {
  std::string names = cause.effect->name;
  for (const std::string& alternative : cause.alternatives) {
    names += " or " + alternative;
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

bool is_stated(const Diagnosis& d, const NamedCause& cause) {
  const auto& keys = cause.effect->amplitudes;
  return std::any_of(keys.begin(), keys.end(),
                     [&](Key key) { return d.context.stated.terms[key] != 0; });
}

std::string what_is_wrong(const Diagnosis& d) {
  std::string lacking;
  std::string otherwise;
  for (const NamedCause& cause : d.causes) {
    std::string& list = is_stated(d, cause) ? otherwise : lacking;
    list += (list.empty() ? "" : ", ") + class_of(cause);
  }
  std::string causes = lacking.empty() ? "" : "the model lacks " + lacking;
  if (!otherwise.empty()) {
    causes +=
        (causes.empty() ? "the model has another size of " : "; has another size of ") + otherwise;
  }
  const std::string moved = moved_parameters(d);
  if (causes.empty() && moved.empty()) {
    return d.unexplained ? "something is missing in the model that no known effect describes"
                         : "nothing: the model explains this data as well as the data can tell";
  }
  std::string out = causes.empty() ? "the structure is right, but off: " + moved : causes;
  if (!causes.empty() && !moved.empty()) {
    out += "; and off: " + moved;
  }
  return out;
}

// By what the first quarter of each held-out run says of its offset and friction.
bool is_worse_held_out(const Diagnosis& d) {
  const Scored& s = d.scored;
  return !s.same_session && (d.causes.empty() ? s.over_supplied95 : s.gain95).high < 0;
}

std::string where_scored(const Diagnosis& d) {
  if (d.scored.same_session) return {};
  return is_worse_held_out(d) ? "; held-out runs are predicted worse, but not surely by 2 % "
                                "where all of each decides its own offset and friction"
                              : "; scored on held-out runs";
}

std::string how_sure(const Diagnosis& d) {
  if (!d.refuted.empty()) {
    return fmt::format("{} predicts some runs better and another surely worse",
                       fmt::join(d.refuted, " with "));
  }
  if (d.causes.empty() && !moved_parameters(d).empty()) {
    return fmt::format(
        "each more than 4 standard errors from the model; of {} groups of effects "
        "none passed alpha = {:g} and cross-validation",
        d.tried, Limits{}.alpha);
  }
  if (d.causes.empty()) {
    return fmt::format("{} groups of effects tried, none passed alpha = {:g} and cross-validation",
                       d.tried, Limits{}.alpha);
  }
  double worst = 0;
  for (const NamedCause& cause : d.causes) {
    worst = std::max(worst, cause.p_value);
  }
  return fmt::format(
      "each at p < {:.1e} after correction for {} tried, and confirmed by cross-validation{}",
      std::max(worst, 1e-300), d.tried, where_scored(d));
}

std::string simulated(const Diagnosis& d, const Units& units) {
  const Windows& w = d.emulated ? d.emulated->windows : d.free_run.windows;
  return w.count == 0
             ? std::string{}
             : fmt::format(
                   "; {} for {:g} s, it ends {:.3g} instead of {:.3g} {} off",
                   d.emulated ? "in the emulator under the measured input alone" : "left to itself",
                   kWindow_s, 1e3 * w.extended_m, 1e3 * w.supplied_m, units.thousandth);
}

std::string what_it_gains(const Diagnosis& d) {
  const Scored& s = d.scored;
  const Units units = units_of(d.context.stated);
  const char* of = s.same_session ? "prediction error" : "held-out prediction error";
  if (d.causes.empty() && moved_parameters(d).empty()) {
    return fmt::format(
        "nothing, the model stays; {:.3g} {} rms of the force is not predicted, "
        "{:.2g} % of it",
        s.after_rms_N, units.force, 100 * s.after_rms_N / std::max(1e-12, s.force_rms_N));
  }
  const bool named = !d.causes.empty();
  const Interval& gain = named ? s.gain95 : s.over_supplied95;
  return fmt::format("{:.1f} % of the {}, {:.3g} to {:.3g} {} rms (95 %: {:.1f} to {:.1f} %){}",
                     100 * gain.value, of, named ? s.before_rms_N : s.supplied_rms_N, s.after_rms_N,
                     units.force, 100 * gain.low, 100 * gain.high, simulated(d, units));
}

std::string in_one_line(const Diagnosis& d) {
  std::string out;
  for (const ParameterShift& shift : d.parameters) {
    out += fmt::format("{}{} {:.4g} {} [{:.4g}, {:.4g}]", out.empty() ? "" : ", ", shift.name,
                       shift.fitted.value, shift.unit, shift.fitted.low, shift.fitted.high);
  }
  return "Estimated:     " + out + ".\n";
}

// With what is written the emulator is no better: it may lack a cause, and that one may be most.
bool ends_no_nearer(const Diagnosis& d) {
  const Windows& w = d.emulated->windows;
  return w.count > 0 && w.extended_m >= w.supplied_m;
}

std::string what_to_use(const Diagnosis& d) {
  if (is_worse_held_out(d)) return "find out in what the held-out runs differ before it is used";
  if (!d.emulated) return "use the parameters and causes of diagnosis.json";
  if (!ends_no_nearer(d)) return "use extended_plant.toml";
  return d.emulated->left_out.empty() ? "keep the supplied plant"
                                      : "use the sizes in diagnosis.json; the emulator lacks them";
}

// What the written plant file is not.
std::string about_the_file(const Diagnosis& d) {
  if (!d.emulated || d.verdicts.front() == "model_adequate") return {};
  std::string out;
  for (const std::string& cause : d.emulated->left_out) {
    out += fmt::format(
        "  extended_plant.toml      lacks {}: the emulator's plant cannot express it\n", cause);
  }
  return ends_no_nearer(d)
             ? out +
                   "  extended_plant.toml      in the emulator ends no nearer to the log than the "
                   "supplied plant\n"
             : out;
}

std::string where_to_look(const Unexplained& u) {
  if (!u.at.empty()) {
    return fmt::format("look at unexplained.csv: what is left depends on {}", u.coordinate);
  }
  const bool follows_nothing = u.coordinate == kOwnPast || u.coordinate == kWholeMotion;
  return fmt::format(
      "look at the residual over time in report.html: {}",
      follows_nothing ? "no coordinate of the motion explains it"
                      : fmt::format("what is left depends on {}, by no known law", u.coordinate));
}

std::string next_step(const Diagnosis& d) {
  if (!d.refuted.empty()) {
    return "find out in what the runs differ; look at the residual over time in report.html";
  }
  for (const NamedCause& cause : d.causes) {
    if (cause.separating) {
      return fmt::format("run {}: it tells {} from {}", cause.separating->motion.words(),
                         cause.effect->name, cause.separating->alternative);
    }
  }
  for (const NamedCause& cause : d.causes) {
    if (!cause.alternatives.empty()) {
      return fmt::format("no motion in reach tells {} apart; {}", class_of(cause),
                         cause.effect->needs);
    }
  }
  if (!d.left_out.empty() || !d.stretches.empty()) {
    return fmt::format("find out what touched the axis in the {} that are left out",
                       d.left_out.empty() ? "stretches" : "runs");
  }
  if (d.unexplained) return where_to_look(*d.unexplained);
  return d.verdicts.front() == "model_adequate"
             ? "nothing; see not_testable for what was out of reach"
             : what_to_use(d);
}

}  // namespace

std::string headline(const Diagnosis& d) {
  if (is_fatal(d.findings)) {
    std::string out = "No diagnosis: the data cannot be used.\n";
    for (const logs::Finding& finding : d.findings) {
      out += fmt::format("  {}: {}\n", finding.name, finding.sentence);
    }
    return out;
  }
  std::string out = fmt::format("What is wrong: {}.\n", what_is_wrong(d));
  out += fmt::format("How sure:      {}.\n", how_sure(d));
  out += fmt::format("What it gains: {}.\n", what_it_gains(d));
  out += d.unexplained
             ? fmt::format("Left over:     {:.3g} {} rms along {}, which no effect explains.\n",
                           d.unexplained->rms_N, units_of(d.context.stated).force,
                           d.unexplained->coordinate)
             : "Left over:     nothing that the residual tests can see.\n";
  out += fmt::format("What to do:    {}.\n", next_step(d));
  out += d.estimated ? in_one_line(d) : std::string{};
  for (const NamedCause& cause : d.causes) {
    out += fmt::format("  {:<24} {}; alone gains {:.1f} % (99 %: {:.1f} to {:.1f})\n",
                       cause.effect->name, cause.effect->cause, 100 * cause.gain99.value,
                       100 * cause.gain99.low, 100 * cause.gain99.high);
  }
  out += about_the_file(d);
  for (const logs::Finding& finding : d.findings) {
    out += fmt::format("  note, {}: {}\n", finding.name, finding.sentence);
  }
  return out;
}

}  // namespace towbench::study::diagnose
