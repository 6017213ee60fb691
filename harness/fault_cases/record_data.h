// A run in memory as the judge reads one from its folder: what formulas look at, without files.
#pragma once

#include "harness/fault_cases/case_record.h"
#include "harness/metrics/run_data.h"

namespace towbench::harness {

// The columns and events that harness/requirements/run_signals.h names.
[[nodiscard]] RunData run_data_of(const CaseRecord& record,
                                  const core::PerAxis<AxisLimits>& limits);

}  // namespace towbench::harness
