// What was put aside, and whether the answer of the rest is taken for that of all.
#pragma once

#include <string>
#include <vector>

#include "study/diagnose/diagnosis.h"

namespace towbench::study::diagnose {

inline constexpr double kUnlike = 2;

// Whether a shape of the motion explains much of what is unexplained: a law is missing, and nobody
// pushed.
[[nodiscard]] bool follows_the_motion(const Diagnosis& d);

// Whether it is worth the time to revise what is found without it; so if nothing was put aside.
[[nodiscard]] bool is_worth_revising(const Aside& aside);

// Whether each of what was put aside lacks more than that many times what the rest lacks.
[[nodiscard]] bool are_unlike(const Diagnosis& rest, double times);

// Whether the rest is explained by itself, and what was put aside is unlike it.
[[nodiscard]] bool explains_the_rest(const Diagnosis& rest, const Diagnosis& all);

// Adds what is `in` the places put aside to what stays unexplained, beside what is in the rest.
void tell_of_aside(const std::string& in, const Diagnosis& all, Diagnosis& rest);

}  // namespace towbench::study::diagnose
