// What modelDescription.xml says of a Co-Simulation unit, as far as the bench needs it.
#pragma once

#include <cstdint>
#include <map>
#include <string>

namespace towbench::harness {

struct FmuVariable {
  std::uint32_t reference = 0;
  bool is_boolean = false;  // else Float64; of other types there is none here
  std::string causality;
};

struct FmuDescription {
  std::string identifier;  // a C identifier: names the binary
  std::string token;
  double fixed_step_s = 0;  // 0: none
  bool serializes_state = false;
  std::map<std::string, FmuVariable> variables;  // by name; scalars only
};

// Empty, or what is wrong in half a sentence.
[[nodiscard]] std::string read_description(const std::string& xml, FmuDescription& description);

}  // namespace towbench::harness
