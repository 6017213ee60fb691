// Why an effect was named, or why not, with its numbers.
#pragma once

#include <string>

#include "study/diagnose/diagnosis.h"

namespace towbench::study::diagnose {

// One or two lines for a person. `effect`: a name of the library.
[[nodiscard]] std::string explain(const Diagnosis& diagnosis, const std::string& effect);

}  // namespace towbench::study::diagnose
