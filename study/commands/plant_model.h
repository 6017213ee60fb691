// The nominal model of a diagnosis, from a plant file.
#pragma once

#include <filesystem>
#include <string>

#include <toml++/toml.h>

#include "study/prediction/nominal_model.h"

namespace towbench::study {

struct PlantModel {
  diagnose::NominalModel model;
  toml::table plant;  // as parsed, to be extended
};

// `axis` is "y" or "x". Break-away, position friction and elasticity count as known only where
// the file states them: a default is no claim about a foreign machine. Throws FixtureError.
[[nodiscard]] PlantModel load_plant_model(const std::filesystem::path& path,
                                          const std::string& axis);

}  // namespace towbench::study
