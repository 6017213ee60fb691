// Hands on what a plant tells to two who listen.
#pragma once

#include "emulator/plant_node.h"

namespace towbench::harness {

class TwoObservers final : public emulator::PlantObserver {
 public:
  // Both outlive this; `second` may be null.
  TwoObservers(emulator::PlantObserver& first, emulator::PlantObserver* second) noexcept
      : first_(first), second_(second) {}

  void on_truth(const emulator::TruthRow& row) noexcept override {
    first_.on_truth(row);
    if (second_ != nullptr) {
      second_->on_truth(row);
    }
  }
  void on_event(const emulator::PlantEvent& event) noexcept override {
    first_.on_event(event);
    if (second_ != nullptr) {
      second_->on_event(event);
    }
  }

 private:
  emulator::PlantObserver& first_;
  emulator::PlantObserver* second_;
};

}  // namespace towbench::harness
