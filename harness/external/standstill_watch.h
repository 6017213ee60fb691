// Since when the machine has stood, from its own truth.
#pragma once

#include <cmath>

#include "emulator/plant_relay.h"

namespace towbench::harness {

class StandstillWatch final : public emulator::PlantRelay {
 public:
  // `observer` hears everything too, and outlives this.
  explicit StandstillWatch(emulator::PlantObserver& observer) noexcept : PlantRelay(observer) {}

  void on_truth(const emulator::TruthRow& row) noexcept override {
    constexpr double kStanding_m_per_s = 2e-3;
    for (const auto& axis : row.axes) {
      if (std::fabs(axis.carriage_speed_m_per_s) > kStanding_m_per_s) {
        moved_ns_ = row.time_ns;
      }
    }
    now_ns_ = row.time_ns;
    PlantRelay::on_truth(row);
  }

  [[nodiscard]] core::Nanoseconds stands_for_ns() const noexcept { return now_ns_ - moved_ns_; }

 private:
  core::Nanoseconds now_ns_ = 0;
  core::Nanoseconds moved_ns_ = 0;
};

}  // namespace towbench::harness
