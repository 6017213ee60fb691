// The columns of a table that a run is made of, and the rows of it that can be used.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "study/logs/column_map.h"
#include "study/logs/finding.h"
#include "study/logs/table.h"

namespace towbench::study::diagnose {

struct LogColumns {
  const std::vector<double>* time = nullptr;
  const std::vector<double>* position = nullptr;
  const std::vector<double>* input = nullptr;
  const std::vector<double>* reference = nullptr;    // null: none
  const std::vector<double>* temperature = nullptr;  // null: none
  std::vector<const std::vector<double>*> others;    // positions of other axes
  std::vector<std::size_t> rows;                     // with sane numbers in all but the reference
};

// Named findings: column_missing, column_twice, bad_rows, not_a_number, absurd_values, too_short,
// constant_position, constant_input. After a fatal one there is nothing to go on with.
[[nodiscard]] LogColumns find_columns(const logs::Table& table, const logs::ColumnMap& map,
                                      const std::string& file, logs::Findings& findings);

}  // namespace towbench::study::diagnose
