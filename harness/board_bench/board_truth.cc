#include "harness/board_bench/board_truth.h"

namespace towbench::harness {

void BoardTruth::on_truth(const emulator::TruthRow& row) noexcept {
  constexpr std::size_t kMostHeld = 10'000;  // a second: an image that starts up logs long before
  if (!first_ns_ && held_.size() == kMostHeld) {
    keep_from(0);
  }
  if (first_ns_) {
    pass(row);
  } else {
    held_.push_back(row);
  }
}

void BoardTruth::keep_from(core::Nanoseconds time_ns) noexcept {
  if (first_ns_) {
    return;
  }
  first_ns_ = time_ns;
  for (const emulator::TruthRow& row : held_) {
    pass(row);
  }
  held_ = {};
}

void BoardTruth::pass(const emulator::TruthRow& row) noexcept {
  if ((row.time_ns - *first_ns_) % period_ns_ == 0) {
    PlantRelay::on_truth(row);
  }
}

}  // namespace towbench::harness
