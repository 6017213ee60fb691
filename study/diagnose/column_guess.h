// What each column of a foreign log seems to be, from its name and from its numbers.
#pragma once

#include <string>
#include <vector>

#include "study/logs/table.h"

namespace towbench::study::diagnose {

enum class Role {
  kNone,
  kTime,
  kPosition,
  kReference,
  kVelocity,
  kInput,
  kOther,  // the position of another axis
  kTemperature
};

struct ColumnGuess {
  std::string name;
  Role role = Role::kNone;
  std::string unit = {};  // by the end of its name: "mm", "rad_per_s"; empty: it does not say
  std::string why = {};   // a clause for a person
  double low = 0;
  double high = 0;
};

// In the order of the header. At most one time, position, reference, input and temperature.
[[nodiscard]] std::vector<ColumnGuess> guess_columns(const logs::Table& table);

}  // namespace towbench::study::diagnose
