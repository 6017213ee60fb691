#include "study/diagnose/explain.h"

#include <algorithm>

#include <fmt/format.h>

namespace towbench::study::diagnose {
namespace {

std::string in_percent(const Interval& gain) {
  return fmt::format("{:.1f} % (99 %: {:.1f} to {:.1f})", 100 * gain.value, 100 * gain.low,
                     100 * gain.high);
}

std::string named(const NamedCause& cause) {
  std::string sizes;
  for (const Size& size : cause.sizes) {
    sizes += fmt::format(", {} {:.4g}", size.name, size.ci95.value);
    if (!size.known) sizes += fmt::format(" [{:.4g}, {:.4g}]", size.ci95.low, size.ci95.high);
  }
  return fmt::format("named: p {:.1e}, its own gain {}{}", cause.p_value, in_percent(cause.gain99),
                     sizes);
}

std::string alternative_of(const NamedCause& cause) {
  std::string out =
      fmt::format("not told from {}: in its place it predicts within two standard errors as well",
                  cause.effect->name);
  if (cause.separating) {
    out += fmt::format("; {} would tell them apart", cause.separating->motion.words());
  }
  return out;
}

std::string of_parameter(const ParameterShift& shift, bool estimated) {
  const std::string fitted =
      fmt::format("{:.4g} {} [{:.4g}, {:.4g}] by the log", shift.fitted.value, shift.unit,
                  shift.fitted.low, shift.fitted.high);
  if (estimated) return "estimated: " + fitted;
  return fmt::format(
      "{}: {}, {:.4g} by the model{}", shift.moved ? "off" : "not named", fitted, shift.supplied,
      shift.moved ? ""
                  : "; more than 4 standard errors, 1 % of it and 1 % of the input are needed");
}

std::string considered(const Considered& c, std::size_t tried) {
  const Limits limits;
  const std::string numbers = fmt::format("p {:.1e} after correction for {} tried, gain {}",
                                          c.p_value, tried, in_percent(c.gain99));
  if (c.p_value >= limits.alpha) {
    return fmt::format("not named: {}; p below {:g} is needed", numbers, limits.alpha);
  }
  if (!c.plausible) {
    return fmt::format(
        "not named: the data ask for a sign or a size that its law does not allow ({})", numbers);
  }
  if (c.gain99.value <= limits.least_gain || c.standard_errors <= limits.least_errors) {
    return fmt::format(
        "not named: {}, {:.1f} standard errors above nothing; more than {:g} % and {:g} standard "
        "errors are needed",
        numbers, c.standard_errors, 100 * limits.least_gain, limits.least_errors);
  }
  return fmt::format(
      "not named: {}; but once fitted it predicts no better than what is named, or is too small "
      "for "
      "a name",
      numbers);
}

}  // namespace

std::string explain(const Diagnosis& d, const std::string& effect) {
  std::string why;
  for (const NamedCause& cause : d.causes) {
    const auto& others = cause.alternatives;
    if (cause.effect->name == effect) why = named(cause);
    if (std::find(others.begin(), others.end(), effect) != others.end())
      why = alternative_of(cause);
  }
  for (const ParameterShift& shift : d.parameters) {
    if (shift.name == effect) why = of_parameter(shift, d.estimated);
  }
  const auto of = [&](const auto& entry) { return entry.effect == effect; };
  const auto blind = std::find_if(d.not_testable.begin(), d.not_testable.end(), of);
  const auto seen = std::find_if(d.considered.begin(), d.considered.end(), of);
  const auto is_in = [&](const std::vector<std::string>& list) {
    return std::find(list.begin(), list.end(), effect) != list.end();
  };
  if (is_in(d.refuted)) {
    why = "not named: some runs speak for it, and another surely against";
  }
  if (why.empty() && is_in(d.dropped)) {
    why =
        "not named: it was accepted and dropped again, because beside what is left unexplained it "
        "says too little, or its law does not fit";
  }
  if (why.empty() && blind != d.not_testable.end()) {
    why = fmt::format("not to be seen in this data: {}; it takes {}", blind->why, blind->needs);
  }
  if (why.empty() && seen != d.considered.end()) why = considered(*seen, d.tried);
  if (why.empty()) {
    why = d.causes.empty() ? "not tried on this data"
                           : "not tried beside what is named, which takes its place";
  }
  return fmt::format("{}: {}.\n", effect, why);
}

}  // namespace towbench::study::diagnose
