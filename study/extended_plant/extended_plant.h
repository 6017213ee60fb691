// The plant file with what was found written into it, as far as the emulator can express it.
#pragma once

#include <string>
#include <vector>

#include <toml++/toml.h>

#include "study/diagnose/diagnosis.h"

namespace towbench::study::diagnose {

struct ExtendedPlant {
  std::string text;                   // TOML, with what could not be said as comments on top
  std::vector<std::string> left_out;  // causes that the emulator's plant cannot express
};

// `plant`: the parsed file that the model came from, motor side or load side. Where something was
// found the fitted parameters replace the file's, and each cause becomes its keys
// (Effect::plant_keys). What is written loads. Throws FixtureError where the given file does not.
[[nodiscard]] ExtendedPlant extend_plant(const toml::table& plant, const Diagnosis& diagnosis);

}  // namespace towbench::study::diagnose
