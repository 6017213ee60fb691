// A hidden log as the diagnosis receives it, and what it answers.
#pragma once

#include <string>
#include <vector>

#include "study/diagnose/diagnosis.h"
#include "tests/study/diagnose/generator/hidden_axis.h"

namespace towbench::tests {

[[nodiscard]] study::diagnose::NominalModel nominal_of(const HiddenAxis& axis);
[[nodiscard]] study::diagnose::Run run_of(const HiddenAxis& axis, const HiddenLog& log);
[[nodiscard]] study::diagnose::Diagnosis diagnose_hidden(const HiddenAxis& axis,
                                                         std::uint64_t seed);

// Every name that the answer gives, one inner list a class.
[[nodiscard]] std::vector<std::vector<std::string>> named(const study::diagnose::Diagnosis& d);

}  // namespace towbench::tests
