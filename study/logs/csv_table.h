// A CSV file of numbers, read once, column by column.
//
// Cells are parted by commas, semicolons or tabs, whichever the header has most of; beside the
// latter two a decimal comma is a point. A byte order mark, quotes, lines that begin with # and one
// empty cell too many at the end of a line are taken as they are meant.
#pragma once

#include <filesystem>

#include "study/logs/datalog_span.h"
#include "study/logs/finding.h"
#include "study/logs/table.h"

namespace towbench::study::logs {

// Streams the file. What cannot be used at all (no file, no header, no rows, rows unlike the
// header, too many rows) is a fatal finding with its line. Only the lines of `span` are looked at.
[[nodiscard]] Table read_csv_table(const std::filesystem::path& path, Findings& findings,
                                   LineSpan span = {});

}  // namespace towbench::study::logs
