// Hands on what a plant tells to two who listen; the second hears truth and events alone.
#pragma once

#include "emulator/plant_relay.h"

namespace towbench::harness {

class TwoObservers final : public emulator::PlantRelay {
 public:
  // Both outlive this; `second` may be null.
  TwoObservers(emulator::PlantObserver& first, emulator::PlantObserver* second) noexcept
      : PlantRelay(first), second_(second) {}

  void on_truth(const emulator::TruthRow& row) noexcept override {
    PlantRelay::on_truth(row);
    if (second_ != nullptr) {
      second_->on_truth(row);
    }
  }
  void on_event(const emulator::PlantEvent& event) noexcept override {
    PlantRelay::on_event(event);
    if (second_ != nullptr) {
      second_->on_event(event);
    }
  }

 private:
  emulator::PlantObserver* second_;
};

}  // namespace towbench::harness
