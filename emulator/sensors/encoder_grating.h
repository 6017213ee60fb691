// Where the grating of an encoder really has its edges: threshold(n) is the true angle, in counts,
// at which the decoded count changes between n - 1 and n.
//
// Ideal: threshold(n) = n. Otherwise, with the electrical period of 4 counts:
//   phase error      shifts both edges of B by (phase - 90 deg) / 90 counts
//   pulse width      shifts the falling edges of A and B by (width - 180 deg) / 90 counts
//   eccentricity     the reading is true + e sin(2 pi true / N - phi); edges sit where the reading
//   is
#pragma once

#include <cstdint>
#include <vector>

#include "core/realtime.h"
#include "emulator/sensors/sensor_parameters.h"

namespace towbench::emulator {

class EncoderGrating {
 public:
  // Parameters are such that thresholds ascend (inconsistency() of the rig refuses others).
  explicit EncoderGrating(const EncoderParameters& parameters);

  [[nodiscard]] bool ideal() const noexcept { return offsets_.empty(); }
  [[nodiscard]] std::int64_t counts_per_turn() const noexcept { return counts_per_turn_; }

  // `in_turn` = count modulo counts_per_turn, kept by the caller: no division per edge.
  TOWBENCH_REALTIME [[nodiscard]] double threshold(std::int64_t count,
                                                   std::int64_t in_turn) const noexcept {
    const double nominal = static_cast<double>(count);
    return offsets_.empty() ? nominal : nominal + offsets_[static_cast<std::size_t>(in_turn)];
  }

  [[nodiscard]] std::int64_t in_turn(std::int64_t count) const noexcept {
    const std::int64_t rest = count % counts_per_turn_;
    return rest < 0 ? rest + counts_per_turn_ : rest;
  }

  // The count whose thresholds enclose a true angle.
  [[nodiscard]] std::int64_t count_at(double angle_counts) const noexcept;

 private:
  std::int64_t counts_per_turn_;
  std::vector<double> offsets_;  // one a count of the turn; empty = ideal
};

}  // namespace towbench::emulator
