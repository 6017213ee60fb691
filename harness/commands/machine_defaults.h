// What machines of one's own take without being told, printed once a machine however many of its
// files `towbench validate` is given; and where rig and controller of an experiment of one's own
// differ. The project's own machines take the nominal values, and differ, on purpose.
#pragma once

#include <filesystem>
#include <map>
#include <set>
#include <string>
#include <vector>

#include "harness/experiment/experiment_fixture.h"
#include "harness/fixtures/unstated_values.h"

namespace towbench::harness {

class MachineDefaults {
 public:
  // Read the file, and with it what it names. Throw FixtureError.
  void of_rig(const std::filesystem::path& path);
  // Told of only when no rig has the plant.
  void of_plant(const std::filesystem::path& path);
  void of_experiment(const ExperimentFixture& fixture);

  void print() const;

 private:
  struct Machine {
    std::vector<UnstatedValue> values;
    bool is_plant = false;
    std::vector<std::filesystem::path> files;  // absolute, this one first
  };
  [[nodiscard]] bool has_its_rig(const Machine& plant) const;

  std::map<std::filesystem::path, Machine> machines_;  // by absolute path
  std::set<std::string> differences_;
};

}  // namespace towbench::harness
