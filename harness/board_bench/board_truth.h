// The truth beside an image on the virtual board: board and plant meet every 100 us, and the record
// keeps the rows that a run of the project's own controller keeps, one an exchange, at the times of
// the image's own log.
//
// Those times are known with the first row of the log. What the plant told before is held.
#pragma once

#include <optional>
#include <vector>

#include "core/time.h"
#include "emulator/plant_relay.h"

namespace towbench::harness {

class BoardTruth final : public emulator::PlantRelay {
 public:
  // `to` outlives this.
  explicit BoardTruth(emulator::PlantObserver& to) noexcept : PlantRelay(to) {}

  void on_truth(const emulator::TruthRow& row) noexcept override;

  // Before the first row: how far they are to be apart.
  void keep_every(core::Nanoseconds period_ns) noexcept { period_ns_ = period_ns; }
  // From the first row on: whole periods from `time_ns`. Said once; later calls change nothing.
  void keep_from(core::Nanoseconds time_ns) noexcept;
  // Nobody has said so till the end.
  void finish() noexcept { keep_from(0); }
  [[nodiscard]] core::Nanoseconds period_ns() const noexcept { return period_ns_; }

 private:
  void pass(const emulator::TruthRow& row) noexcept;

  core::Nanoseconds period_ns_ = core::kPlantTick_ns;
  std::optional<core::Nanoseconds> first_ns_;
  std::vector<emulator::TruthRow> held_;
};

}  // namespace towbench::harness
