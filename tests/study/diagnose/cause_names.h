// What a diagnosis names, without its alternatives.
#pragma once

#include <string>
#include <vector>

#include "study/diagnose/diagnosis.h"

namespace towbench::tests {

inline std::vector<std::string> cause_names(const study::diagnose::Diagnosis& d) {
  std::vector<std::string> names;
  for (const auto& cause : d.causes) names.push_back(cause.effect->name);
  return names;
}

}  // namespace towbench::tests
