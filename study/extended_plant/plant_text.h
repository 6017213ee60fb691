// A plant file while it is changed: keys of one axis, in either form of the file, and never one
// that the emulator refuses.
#pragma once

#include <string>
#include <vector>

#include <toml++/toml.h>

#include "emulator/rig_parameters.h"
#include "study/prediction/plant_values.h"

namespace towbench::study::diagnose {

class PlantText {
 public:
  // Throws FixtureError where the emulator refuses the file. `stated`: with what the data says.
  PlantText(toml::table plant, StatedPlant stated);

  // Keys and values of the motor side. False, and nothing is changed, where there is no value or
  // the emulator refuses the file with them.
  bool set(const std::vector<std::string>& keys, const PlantValues& values);

  [[nodiscard]] const StatedPlant& stated() const noexcept { return stated_; }
  [[nodiscard]] const emulator::RigParameters& machine() const noexcept { return machine_; }
  [[nodiscard]] std::string text() const;

 private:
  void put(toml::table& plant, const std::string& key, const PlantValue& value) const;
  void read();

  toml::table plant_;
  StatedPlant stated_;
  emulator::RigParameters machine_;
};

// As the emulator reads a plant file. Throws FixtureError.
[[nodiscard]] emulator::RigParameters machine_of(const toml::table& plant);

}  // namespace towbench::study::diagnose
