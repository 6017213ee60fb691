// What a person reads: the first five lines say what is wrong, how sure, what it gains, what next.
#pragma once

#include <string>

#include "study/diagnose/diagnosis.h"

namespace towbench::study::diagnose {

[[nodiscard]] std::string headline(const Diagnosis& diagnosis);

}  // namespace towbench::study::diagnose
