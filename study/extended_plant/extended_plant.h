// The plant file with what was found written into it, as far as the emulator has words for it.
#pragma once

#include <string>
#include <vector>

#include <toml++/toml.h>

#include "study/diagnose/diagnosis.h"

namespace towbench::study::diagnose {

struct ExtendedPlant {
  std::string text;                   // TOML, with what could not be said as comments on top
  std::vector<std::string> left_out;  // effects that the emulator's plant cannot express
};

// `plant`: the parsed file that the model came from, motor side or load side. Where something
// was found the refitted parameters replace the file's, and effects that the plant has keys for
// become keys; a transmission keeps its stiffness.
[[nodiscard]] ExtendedPlant extend_plant(const toml::table& plant, const Diagnosis& diagnosis);

}  // namespace towbench::study::diagnose
