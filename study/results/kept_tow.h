// A tow experiment's outcome on disk, so that an interrupted set of results continues.
#pragma once

#include <nlohmann/json.hpp>

#include "study/procedures/tow/tow_procedure.h"

namespace towbench::study {

[[nodiscard]] nlohmann::json tow_to_json(const procedures::TowOutcome& outcome);
// Throws nlohmann::json::exception.
[[nodiscard]] procedures::TowOutcome tow_from_json(const nlohmann::json& json);

}  // namespace towbench::study
