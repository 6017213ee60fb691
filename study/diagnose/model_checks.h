// What only shows once the model meets the data: reversed sign, wrong unit, shifted columns.
#pragma once

#include "study/diagnose/effect.h"
#include "study/diagnose/finding.h"

namespace towbench::harness::diagnose {

// Named findings: command_sign_reversed, input_unit_off, columns_shifted, model_explains_little,
// model_explains_nothing.
void check_against_model(const Dataset& data, const Context& context, Findings& findings);

}  // namespace towbench::harness::diagnose
