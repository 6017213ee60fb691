// What a bench logged of one run: the columns an estimator may see, and nothing else.
//
// One row a control tick. Sensor columns hold the latest sample at that time; they are empty when
// the machine has no such sensor (or the log no such column).
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "core/axis.h"

namespace towbench::study::identify {

// AxisRecording::mode while the position loop follows its reference: bbmc::AxisMode::kPosition.
inline constexpr std::uint8_t kFollowsReference = 2;

struct AxisRecording {
  std::vector<std::int64_t> count;
  std::vector<double> duty_pct;  // as written to the PWM, held until the next row
  std::vector<double> reference_m;
  std::vector<double> reference_velocity_m_per_s;
  std::vector<double> velocity_m_per_s;  // the controller's own estimate
  std::vector<std::uint8_t> mode;        // bbmc::AxisMode as a number
  std::vector<double> current_A;         // of the amplifier's monitor
};

struct Recording {
  std::vector<double> time_s;
  core::PerPlanarAxis<AxisRecording> axes;
  // Between mount and shaft, tank frame: X across, Y along the tank.
  core::PerPlanarAxis<std::vector<double>> force_N;
  double period_s = 0;  // of the rows
  core::PerPlanarAxis<double> metres_per_count{};
  core::PerPlanarAxis<double> rad_per_count{};  // of the motor
  // The controller's console, as far as it is kept.
  std::string console;
  std::string trouble;  // empty: the run went to its end and latched no fault

  [[nodiscard]] std::size_t rows() const noexcept { return time_s.size(); }
  [[nodiscard]] double position_m(core::Axis axis, std::size_t row) const noexcept {
    return (static_cast<double>(axes[axis].count[row]) + 0.5) * metres_per_count[axis];
  }
};

}  // namespace towbench::study::identify
