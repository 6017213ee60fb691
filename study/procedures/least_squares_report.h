// Ordinary least squares beside output error: how far it is off, why, and with which filter.
#pragma once

#include "study/procedures/two_mass_report.h"

namespace towbench::study::procedures {

void report_least_squares(const TwoMassReport& report, ProcedureOutcome& outcome);

}  // namespace towbench::study::procedures
