// What a diagnosis answers, and nothing else of it: the only file that knows its shape.
#pragma once

#include <string>
#include <vector>

#include "study/diagnose/diagnosis.h"

namespace towbench::tests::foreign {

struct Named {
  std::vector<std::string> names;  // the cause, then what explains the data as well
  double p_value = 1;
};

struct Answer {
  std::vector<Named> causes;  // accepted causes, then parameters that moved
  bool unexplained = false;
  bool adequate = false;
  double gain_pct = 0;                      // of all, on held-out data
  std::string refusal;                      // the name of what made the data unusable
  [[nodiscard]] std::string words() const;  // "stribeck~stiction coulomb"
};

[[nodiscard]] Answer answer_of(const study::diagnose::Diagnosis& diagnosis);

}  // namespace towbench::tests::foreign
