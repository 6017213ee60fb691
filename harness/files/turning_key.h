// The keys of an axis whose load turns. A unit is part of a key (core/parameter.h): what is min_m
// and stiffness_N_per_m of a load that moves in a line is min_rad and stiffness_Nm_per_rad of one
// that turns.
#pragma once

#include <array>
#include <string>
#include <string_view>
#include <utility>

namespace towbench::harness {

// The key itself where its unit is none of the load's (Nm and rad of the motor's side, s, deg).
[[nodiscard]] inline std::string turning_key(std::string_view key_of_a_line) {
  using Units = std::pair<std::string_view, std::string_view>;
  constexpr std::array kUnits{Units{"_N_per_m", "_Nm_per_rad"},
                              Units{"_N_s_per_m", "_Nm_s_per_rad"},
                              Units{"_m_per_s", "_rad_per_s"},
                              Units{"_m_per_s2", "_rad_per_s2"},
                              Units{"_N", "_Nm"},
                              Units{"_kg", "_kg_m2"},
                              Units{"_m", "_rad"}};
  for (const auto& [of_a_line, turning] : kUnits) {
    if (key_of_a_line.ends_with(of_a_line)) {
      key_of_a_line.remove_suffix(of_a_line.size());
      return std::string(key_of_a_line).append(turning);
    }
  }
  return std::string(key_of_a_line);
}

}  // namespace towbench::harness
