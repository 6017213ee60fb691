// What the thesis prints of its own tracking on Y, in its units.
#pragma once

#include <array>
#include <cstddef>
#include <vector>

namespace towbench::study {

struct ThesisTracking {
  double speed_mm_per_s;
  double position_error_mm;  // mean
  double velocity_error_mm_per_s;
};

inline constexpr std::array<ThesisTracking, 14> kTable7_6{{{5, 1.226e-3, -2.873e-4},
                                                           {10, 1.391e-3, -3.783e-4},
                                                           {20, 1.195e-3, -4.269e-4},
                                                           {30, 1.153e-3, -4.334e-4},
                                                           {40, 1.170e-3, -2.669e-4},
                                                           {50, 1.63e-3, -2.668e-4},
                                                           {60, 1.194e-3, -2.611e-4},
                                                           {70, 1.195e-3, -2.516e-4},
                                                           {80, 1.117e-3, -2.224e-4},
                                                           {90, 1.116e-3, -2.086e-4},
                                                           {100, 0.988e-3, -2.456e-4},
                                                           {200, 0.919e-3, -3.022e-4},
                                                           {300, 1.093e-3, -6.327e-4},
                                                           {400, 1.645e-3, -1.242e-4}}};

inline constexpr std::array<ThesisTracking, 6> kTable8_3{{{50, 0.336, 1.69e-2},
                                                          {150, 0.581, 6.9e-2},
                                                          {250, 0.817, 9.87e-2},
                                                          {350, 1.8, 3.8e-2},
                                                          {450, 1.9, 1.63e-2},
                                                          {550, 3.9, 2.31e-2}}};

template <std::size_t Rows>
[[nodiscard]] std::vector<double> speeds_of(const std::array<ThesisTracking, Rows>& table) {
  std::vector<double> speeds_m_per_s;
  for (const auto& row : table) {
    speeds_m_per_s.push_back(1e-3 * row.speed_mm_per_s);
  }
  return speeds_m_per_s;
}

}  // namespace towbench::study
