// For a plant whose record nobody asked for.
#pragma once

#include "emulator/plant_node.h"

namespace towbench::harness {

class UnrecordedPlant final : public emulator::PlantObserver {
 public:
  void on_truth(const emulator::TruthRow& /*row*/) noexcept override {}
  void on_event(const emulator::PlantEvent& /*event*/) noexcept override {}
};

}  // namespace towbench::harness
