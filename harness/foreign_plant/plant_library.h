// A shared library with the functions of clients/plant/plant_abi.h.
#pragma once

#include <filesystem>

#include "harness/foreign_plant/loaded_plant.h"

namespace towbench::harness {

class PlantLibrary final : public PlantBinary {
 public:
  // `parameters`: lines of "key = value".
  PlantLibrary(std::filesystem::path file, std::string parameters)
      : file_(std::move(file)), parameters_(std::move(parameters)) {}

  [[nodiscard]] std::unique_ptr<LoadedPlant> load(const std::vector<PlantAxis>& axes,
                                                  std::string& why) const override;

 private:
  std::filesystem::path file_;
  std::string parameters_;
};

}  // namespace towbench::harness
