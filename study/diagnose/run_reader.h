// From a table to a run: units, uniform time, gaps, steps, with what is odd told by name.
#pragma once

#include <string>

#include "study/logs/column_map.h"
#include "study/logs/table.h"
#include "study/prediction/run.h"

namespace towbench::study::diagnose {

// Named findings: those of log_columns.h, time_grid.h and position_jump.h. After a fatal one the
// run is unusable.
[[nodiscard]] Run make_run(const logs::Table& table, const logs::ColumnMap& map, std::string name,
                           logs::Findings& findings);

}  // namespace towbench::study::diagnose
