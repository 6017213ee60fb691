// A procedure's outcome on disk, so that an interrupted set continues where it stopped.
#pragma once

#include <nlohmann/json.hpp>

#include "study/procedures/procedure.h"

namespace towbench::study::procedures {

[[nodiscard]] nlohmann::json to_json(const ProcedureOutcome& outcome);
// Throws nlohmann::json::exception.
[[nodiscard]] ProcedureOutcome outcome_from_json(const nlohmann::json& json);

}  // namespace towbench::study::procedures
