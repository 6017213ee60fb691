// Since when the machine has stood, from its own truth.
#pragma once

#include <cmath>

#include "emulator/plant_node.h"

namespace towbench::harness {

class StandstillWatch final : public emulator::PlantObserver {
 public:
  // `observer` hears everything too, and outlives this.
  explicit StandstillWatch(emulator::PlantObserver& observer) noexcept : observer_(observer) {}

  void on_truth(const emulator::TruthRow& row) noexcept override {
    constexpr double kStanding_m_per_s = 2e-3;
    for (const auto& axis : row.axes) {
      if (std::fabs(axis.carriage_speed_m_per_s) > kStanding_m_per_s) {
        moved_ns_ = row.time_ns;
      }
    }
    now_ns_ = row.time_ns;
    observer_.on_truth(row);
  }
  void on_event(const emulator::PlantEvent& event) noexcept override { observer_.on_event(event); }
  void on_refusal(const protocol::Hello& ours, const protocol::Hello& theirs,
                  core::ErrorCode why) noexcept override {
    observer_.on_refusal(ours, theirs, why);
  }

  [[nodiscard]] core::Nanoseconds stands_for_ns() const noexcept { return now_ns_ - moved_ns_; }

 private:
  emulator::PlantObserver& observer_;
  core::Nanoseconds now_ns_ = 0;
  core::Nanoseconds moved_ns_ = 0;
};

}  // namespace towbench::harness
