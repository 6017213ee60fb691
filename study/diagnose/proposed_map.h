// A log that came without a map: what its columns seem to be, a map to correct, and what no log can
// say.
#pragma once

#include <string>

#include "study/logs/table.h"

namespace towbench::study::diagnose {

// TOML with a comment behind each line that is a guess; a column that was not found stands as a
// comment.
[[nodiscard]] std::string proposed_map(const logs::Table& table);

// Rows, period, each column with its range and what it seems to be; the map; what must be told, and
// what is estimated.
[[nodiscard]] std::string explain_columns(const logs::Table& table, const std::string& file);

}  // namespace towbench::study::diagnose
