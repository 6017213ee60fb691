// What a diagnosis leaves open: causes that its data cannot tell apart, and what would.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "study/diagnose/diagnosis.h"

namespace towbench::study::active {

// The two that only a known force tells apart.
inline constexpr const char* kAmplifierGain = "amplifier_gain";
inline constexpr const char* kAllByOneRatio = "inertia, viscous and coulomb by one ratio";

struct Question {
  enum class Means { kMotion, kKnownForce, kNone };
  std::vector<std::string> causes;  // the class
  Means means = Means::kNone;
  diagnose::TrialMotion motion{};  // of kMotion, kKnownForce
  double push_N = 0;               // of kKnownForce
  double ratio = 1;                // of kKnownForce: by which the gain would have to be off
  std::string why{};               // kNone: why no experiment of the bench separates them
};

// In the order in which they are worth asking: what an experiment can answer first.
[[nodiscard]] std::vector<Question> open_questions(const diagnose::Diagnosis& d);

// Every name that the diagnosis gives, a class as "a or b"; what an answered question excludes is
// left to the caller.
[[nodiscard]] std::string names_of(const diagnose::Diagnosis& d);
[[nodiscard]] std::string joined(const std::vector<std::string>& names, const char* between);

}  // namespace towbench::study::active
