// Table 7.6 of the thesis, Y: what its controller did at 14 speeds.
#pragma once

#include <array>

namespace towbench::tests {

struct Row7_6 {
  double speed_mm_per_s;
  double velocity_error_mm_per_s;
  double position_error_mm;
};

inline constexpr std::array<Row7_6, 14> kTable7_6{{
    {5, -2.873e-4, 1.226e-3},
    {10, -3.783e-4, 1.391e-3},
    {20, -4.269e-4, 1.195e-3},
    {30, -4.334e-4, 1.153e-3},
    {40, -2.669e-4, 1.170e-3},
    {50, -2.668e-4, 1.63e-3},
    {60, -2.611e-4, 1.194e-3},
    {70, -2.516e-4, 1.195e-3},
    {80, -2.224e-4, 1.117e-3},
    {90, -2.086e-4, 1.116e-3},
    {100, -2.456e-4, 0.988e-3},
    {200, -3.022e-4, 0.919e-3},
    {300, -6.327e-4, 1.093e-3},
    {400, -1.242e-4, 1.645e-3},
}};

}  // namespace towbench::tests
