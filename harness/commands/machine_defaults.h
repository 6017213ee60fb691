// What machines of one's own take without being told, printed once a machine however many of its
// files `towbench validate` is given. The project's own machines take the nominal values on purpose
// and are not told of.
#pragma once

#include <filesystem>
#include <map>
#include <vector>

#include "harness/fixtures/unstated_values.h"

namespace towbench::harness {

class MachineDefaults {
 public:
  // Read the file, and with it what it names. Throw FixtureError.
  void of_rig(const std::filesystem::path& path);
  // Told of only when no rig has the plant.
  void of_plant(const std::filesystem::path& path);

  void print() const;

 private:
  struct Machine {
    std::vector<UnstatedValue> values;
    bool is_plant = false;
    std::vector<std::filesystem::path> files;  // absolute, this one first
  };
  [[nodiscard]] bool has_its_rig(const Machine& plant) const;

  std::map<std::filesystem::path, Machine> machines_;  // by absolute path
};

}  // namespace towbench::harness
