// A requirement on the signals of a run, as an experiment states it: [[requirement]].
#pragma once

#include <string>

#include "harness/signal_logic/formula_text.h"

namespace towbench::harness {

struct Requirement {
  std::string id{};
  std::string text{};  // of the formula
  ParsedFormula parsed{};
  std::string source{};
  // Asked of a machine that was broken too. Else it speaks of the sound one, as a budget does.
  bool under_faults = false;
};

}  // namespace towbench::harness
