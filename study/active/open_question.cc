#include "study/active/open_question.h"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

namespace towbench::study::active {
namespace {

using diagnose::Diagnosis;
using diagnose::NamedCause;
using diagnose::ParameterShift;
using Means = Question::Means;

Question about(const NamedCause& cause) {
  Question q{.causes = {cause.effect->name}};
  for (const auto& alternative : cause.alternatives) {
    q.causes.push_back(alternative);
  }
  if (cause.separating) {
    q.means = Means::kMotion;
    q.motion = cause.separating->motion;
  } else {
    q.why = fmt::format("no motion of the menu separates them half as well again as this data; {}",
                        cause.effect->needs);
  }
  return q;
}

const NamedCause* gain_cause(const Diagnosis& d) {
  for (const NamedCause& cause : d.causes) {
    if (cause.effect->name == kAmplifierGain) {
      return &cause;
    }
  }
  return nullptr;
}

// Whether a wrong gain is named, as a cause or as what stands behind all parameters.
bool gain_is_named(const Diagnosis& d) {
  return gain_cause(d) != nullptr || diagnose::may_be_gain(d.parameters);
}

// Slow and smooth, over a good part of the stroke: what counts is how long each direction lasts.
diagnose::TrialMotion weighing_motion(const diagnose::Context& c) {
  constexpr double kFrequency_Hz = 0.25;
  constexpr double kTurn = 6.283185307179586;
  const double w = kTurn * kFrequency_Hz;
  const double amplitude = std::min(0.4 * c.stroke_m, 0.6 * c.top_speed_m_per_s / w);
  return {.kind = diagnose::TrialMotion::Kind::kSine,
          .centre_m = c.stroke_min_m + 0.5 * c.stroke_m,
          .amplitude_m = amplitude,
          .speed_m_per_s = amplitude * w,
          .acceleration_m_per_s2 = amplitude * w * w,
          .frequency_Hz = kFrequency_Hz};
}

// Of the order of dry friction: a controller that had to command much more at the turning points
// would take its encoder for frozen.
double push_of(const Diagnosis& d) {
  constexpr double kOfFriction = 1.5;
  return kOfFriction * d.extended[diagnose::Key::kCoulomb];
}

Question about_gain(const Diagnosis& d) {
  const NamedCause* cause = gain_cause(d);
  const ParameterShift& mass = d.parameters[diagnose::kInertia];
  return {.causes = {kAmplifierGain, kAllByOneRatio},
          .means = Means::kKnownForce,
          .motion = weighing_motion(d.context),
          .push_N = push_of(d),
          .ratio = cause != nullptr ? 1 / (1 - cause->sizes.front().ci95.value)
                                    : mass.fitted.value / mass.supplied};
}

// Classes that the algebra makes, whatever the motion.
std::optional<Question> about(const ParameterShift& shift) {
  if (!shift.moved) {
    return std::nullopt;
  }
  if (shift.name == "bias") {
    return Question{.causes = {"constant_bias", "coulomb_asymmetry"},
                    .why =
                        "C sgn v + dC is one constant force more at every speed and place, so "
                        "no motion separates them; a level on the rails does"};
  }
  if (shift.name == "inertia") {
    return Question{.causes = {"inertia", "added_mass"},
                    .why =
                        "mass is mass to every motion; weighing the carriage, or the same run "
                        "out of the water, separates them"};
  }
  return std::nullopt;
}

}  // namespace

std::vector<Question> open_questions(const Diagnosis& d) {
  std::vector<Question> out;
  if (gain_is_named(d)) {
    out.push_back(about_gain(d));
  }
  for (const NamedCause& cause : d.causes) {
    if (!cause.alternatives.empty()) {
      out.push_back(about(cause));
    }
  }
  for (const ParameterShift& shift : d.parameters) {
    const auto question = about(shift);
    if (question && !(gain_is_named(d) && shift.name == "inertia")) {
      out.push_back(*question);
    }
  }
  std::stable_partition(out.begin(), out.end(),
                        [](const Question& q) { return q.means != Means::kNone; });
  return out;
}

std::string joined(const std::vector<std::string>& names, const char* between) {
  return fmt::format("{}", fmt::join(names, between));
}

std::string names_of(const Diagnosis& d) {
  std::vector<std::string> all;
  for (const NamedCause& cause : d.causes) {
    std::vector<std::string> names{cause.effect->name};
    for (const auto& alternative : cause.alternatives) {
      names.push_back(alternative);
    }
    all.push_back(joined(names, " or "));
  }
  for (const ParameterShift& shift : d.parameters) {
    if (shift.moved) {
      const auto question = about(shift);
      all.push_back(question ? joined(question->causes, " or ") : shift.name);
    }
  }
  return all.empty() ? "nothing" : joined(all, ", ");
}

}  // namespace towbench::study::active
