// What a run must not do if its columns are what the map and the model take them for.
#pragma once

#include "study/logs/finding.h"
#include "study/prediction/nominal_model.h"
#include "study/prediction/run.h"

namespace towbench::study::diagnose {

// Named findings: position_unit_off (faster than the machine can be), input_unit_off (more than its
// whole command), position_sign_reversed (against its reference); reference_unit_off and
// reference_not_followed (then the run goes on without its reference).
void check_run(Run& run, const NominalModel& model, logs::Findings& findings);

}  // namespace towbench::study::diagnose
