// Logs and a plant file in, a folder with the diagnosis out: what the verb does once, and an active
// diagnosis once a round.
#pragma once

#include <cstdint>
#include <filesystem>
#include <stdexcept>
#include <string>
#include <vector>

#include "study/commands/plant_model.h"
#include "study/diagnose/diagnosis.h"

namespace towbench::study {

// What was given cannot be diagnosed: one line, exit code 2.
class UnusableData : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

struct DiagnoseOptions {
  std::string model;
  std::vector<std::string> data;
  std::vector<std::string> holdout;
  std::string columns;
  std::string axis = "y";
  std::string out = "diagnosis";
  std::uint64_t seed = 1;
  std::vector<std::string> explain;  // effects
  bool quiet = false;
  bool json = false;
};

// Neither a plant file nor a run folder with one: mass and friction are then estimated.
[[nodiscard]] bool has_no_model(const DiagnoseOptions& options);
// Of a log without a map: what its columns seem to be, and a map to correct. Throws UnusableData.
[[nodiscard]] std::string explained_columns(const DiagnoseOptions& options);
[[nodiscard]] PlantModel plant_of(const DiagnoseOptions& options);

// The model that was asked for, or the plant that the first run folder says it was run with.
[[nodiscard]] std::filesystem::path model_of(const DiagnoseOptions& options);

// Throws UnusableData, FixtureError.
[[nodiscard]] diagnose::Run read_log(const std::string& path, const DiagnoseOptions& options,
                                     diagnose::NominalModel& model, logs::Findings& findings);
[[nodiscard]] diagnose::Diagnosis diagnose_logs(const DiagnoseOptions& options, PlantModel plant);

// Every file of a diagnosis into options.out. Throws UnusableData when there is none to write.
void write_diagnosis(const DiagnoseOptions& options, const PlantModel& plant,
                     const diagnose::Diagnosis& d);

}  // namespace towbench::study
