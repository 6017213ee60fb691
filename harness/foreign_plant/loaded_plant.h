// A plant binary inside its own process: what the process of a run tells it to do.
#pragma once

#include <cstddef>
#include <memory>
#include <string>
#include <vector>

#include "clients/plant/plant_abi.h"

namespace towbench::harness {

// A machine's axes in the order of inputs and outputs.
struct PlantAxis {
  std::string name;
  double start_m = 0;
};

// Calls of the binary; any of them may crash or never come back.
class LoadedPlant {
 public:
  LoadedPlant() = default;
  LoadedPlant(const LoadedPlant&) = delete;
  LoadedPlant& operator=(const LoadedPlant&) = delete;
  virtual ~LoadedPlant() = default;

  // False: `message`, of `size` bytes, may say why.
  [[nodiscard]] virtual bool step(double until_s, const towbench_plant_input* inputs,
                                  towbench_plant_output* outputs, double& reached_s, char* message,
                                  std::size_t size) = 0;
  // 0: not offered.
  [[nodiscard]] virtual std::size_t state_size() = 0;
  [[nodiscard]] virtual bool save(void* state) = 0;
  [[nodiscard]] virtual bool restore(const void* state) = 0;
};

// A file that makes plants.
class PlantBinary {
 public:
  PlantBinary() = default;
  PlantBinary(const PlantBinary&) = delete;
  PlantBinary& operator=(const PlantBinary&) = delete;
  virtual ~PlantBinary() = default;
  // Called in the plant's own process. Null: `why` says it in half a sentence.
  [[nodiscard]] virtual std::unique_ptr<LoadedPlant> load(const std::vector<PlantAxis>& axes,
                                                          std::string& why) const = 0;
};

}  // namespace towbench::harness
