// Machines with a plant of their own, for tests.
#pragma once

#include <filesystem>
#include <string>

#include "harness/foreign_plant/isolated_plant.h"
#include "harness/foreign_plant/plant_library.h"
#include "tests/harness/end_to_end/run_support.h"
#include "tests/support/program_output.h"

namespace towbench::harness {

inline std::filesystem::path plant_library(const std::string& name) {
  return std::filesystem::path(TOWBENCH_PLANTS) / ("lib" + name + ".so");
}

inline std::shared_ptr<const emulator::ForeignPlantSource> plant_source(
    const std::string& name, const std::string& parameters, double answer_limit_s = 10.0) {
  return make_plant_source(
      {.name = name,
       .binary = std::make_shared<PlantLibrary>(plant_library(name), parameters),
       .answer_limit_s = answer_limit_s});
}

// The stage of docs/guide/your-plant.md: files of `towbench new-machine`, and a table [plant].
class Stage {
 public:
  explicit Stage(const std::string& library = "screw_stage", const std::string& parameters = "",
                 const std::string& more = "") {
    const auto written = tests::output_of(
        tests::quoted(TOWBENCH_PROGRAM) + " new-machine --out " + folder().string() +
        " --name stage --transmission screw --lead-m 5e-3 --mass-kg 20 --stroke-m 0.4"
        " --rotor-inertia-kg-m2 2e-5 --torque-constant-Nm-per-A 0.06 --resistance-ohm 1.2"
        " --amplifier-gain-A-per-V 0.8 --current-limit-A 8 --supply-V 48 --encoder-lines 2000"
        " --switches both </dev/null");
    EXPECT_EQ(written.code, kExitPass) << written.text;
    std::filesystem::copy_file(plant_library(library), folder() / "plant.so");
    std::ofstream(folder() / "rig.toml", std::ios::app) << "\n[plant]\nfile = \"plant.so\"\n"
                                                        << more << "[plant.parameters]\n"
                                                        << parameters;
  }

  [[nodiscard]] std::filesystem::path folder() const { return files_.folder() / "stage"; }
  [[nodiscard]] ExperimentFixture experiment() const {
    return load_experiment(folder() / "experiment.toml");
  }

 private:
  TemporaryFixtures files_;
};

}  // namespace towbench::harness
