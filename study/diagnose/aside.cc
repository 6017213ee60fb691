#include "study/diagnose/aside.h"

#include <algorithm>

namespace towbench::study::diagnose {
namespace {

constexpr double kMayBeUnlike = 1.5;  // before what is found is revised
constexpr double kQuiteUnlike = 5;    // where something stays unexplained in it too
constexpr double kSure = 2.58;        // standard errors: 99 %
constexpr double kByALaw = 0.4;       // of what is unexplained, explained by the motion
constexpr double kMost = 0.85;        // of the prediction error: a shape that leaves less is a law

// That `all` does not have: it takes on what is not its own.
bool has_new_free_shape(const Diagnosis& rest, const Diagnosis& all) {
  return std::any_of(rest.causes.begin(), rest.causes.end(), [&](const NamedCause& cause) {
    return cause.effect->flexible &&
           std::none_of(all.causes.begin(), all.causes.end(),
                        [&](const NamedCause& other) { return other.effect == cause.effect; });
  });
}

bool surely_gains(const NamedCause& cause) {
  return cause.standard_errors > kSure;
}

// Against an answer that needs none: a free shape or a clip that may gain nothing took on a push,
// though many blocks gain by it.
bool stands(const NamedCause& cause) {
  const Effect& effect = *cause.effect;
  return !(effect.flexible || effect.is_clip()) || cause.gain99.low > 0;
}

bool lack_more_than(const Aside& aside, double times) {
  const double least_N = *std::min_element(aside.rms_N.begin(), aside.rms_N.end());
  return least_N > times * aside.others_rms_N;
}

}  // namespace

bool follows_the_motion(const Diagnosis& d) {
  if (!d.unexplained) return false;
  const std::string& of = d.unexplained->coordinate;
  const bool is_shape = of != "time" && of != kOwnPast && of != kWholeMotion;
  return is_shape && d.unexplained->share > kByALaw;
}

bool is_worth_revising(const Aside& aside) {
  return aside.rms_N.empty() || lack_more_than(aside, kMayBeUnlike);
}

bool are_unlike(const Diagnosis& rest, double times) {
  return lack_more_than(rest.aside, times);
}

bool explains_the_rest(const Diagnosis& rest, const Diagnosis& all) {
  if (is_fatal(rest.findings)) return false;
  const bool all_has_one = std::any_of(all.causes.begin(), all.causes.end(), stands);
  if (rest.causes.empty() && (rest.unexplained || all_has_one)) return false;
  const bool explains_most = rest.scored.gain95.value > kMost;
  if (!explains_most && has_new_free_shape(rest, all)) return false;
  if (!std::all_of(rest.causes.begin(), rest.causes.end(), surely_gains)) return false;
  return are_unlike(rest, rest.unexplained ? kQuiteUnlike : kUnlike);
}

void tell_of_aside(const std::string& in, const Diagnosis& all, Diagnosis& rest) {
  if (rest.unexplained) return;
  rest.verdicts.emplace_back("unexplained_structure");
  const double most_N = *std::max_element(rest.aside.rms_N.begin(), rest.aside.rms_N.end());
  rest.unexplained = Unexplained{.coordinate = "time in " + in,
                                 .share = 1 - rest.aside.others_rms_N / most_N,
                                 .rms_N = most_N,
                                 .p_value = all.unexplained ? all.unexplained->p_value : 0};
  std::erase(rest.verdicts, "model_adequate");
}

}  // namespace towbench::study::diagnose
