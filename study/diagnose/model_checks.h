// Whether the columns are what they are said to be, asked before any fit.
#pragma once

#include <vector>

#include "study/diagnose/momentum.h"
#include "study/logs/finding.h"

namespace towbench::study::diagnose {

// Named findings: too_little_motion, columns_shifted, model_explains_nothing,
// model_explains_little, command_sign_reversed, input_unit_off.
void check_against_model(const std::vector<Run>& runs, const NominalModel& model,
                         logs::Findings& findings);

}  // namespace towbench::study::diagnose
