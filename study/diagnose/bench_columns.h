// Which column of the bench's own log is what, by the columns it has: count before position, duty
// before force.
#pragma once

#include <string>

#include "study/logs/column_map.h"
#include "study/logs/finding.h"
#include "study/logs/table.h"
#include "study/prediction/nominal_model.h"

namespace towbench::study::diagnose {

// A log without time, position or input is the fatal finding columns_unusable.
[[nodiscard]] logs::ColumnMap bench_columns(const logs::Table& table, const NominalModel& model,
                                            const std::string& file, logs::Findings& findings);

// A map that names counts or a duty, in metres and newtons by the model. What the model does not
// state is the fatal finding columns_unusable.
void use_model_units(logs::ColumnMap& map, const NominalModel& model, const std::string& file,
                     logs::Findings& findings);

}  // namespace towbench::study::diagnose
