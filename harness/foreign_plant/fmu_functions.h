// The functions of a unit's shared library.
#pragma once

#include <filesystem>
#include <string>

#include "emulator/fmi/fmi3.h"

namespace towbench::harness {

// False: `why` says it in half a sentence. The library stays loaded.
[[nodiscard]] bool load_fmu_functions(const std::filesystem::path& library, bool with_state,
                                      fmi3::Functions& functions, std::string& why);

}  // namespace towbench::harness
