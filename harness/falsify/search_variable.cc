#include "harness/falsify/search_variable.h"

#include <algorithm>
#include <cmath>

namespace towbench::harness {

double value_at(const SearchVariable& variable, double share) noexcept {
  double value = variable.logarithmic ? variable.from * std::pow(variable.to / variable.from, share)
                                      : variable.from + (variable.to - variable.from) * share;
  value = std::clamp(value, variable.from, variable.to);
  return variable.whole ? std::round(value) : value;
}

}  // namespace towbench::harness
