#include "study/procedures/log_file.h"

#include <cmath>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "harness/fixtures/fixture_error.h"
#include "study/logs/csv_table.h"
#include "study/logs/read_table.h"

namespace towbench::study::procedures {

void refuse_fatal(const logs::Findings& findings, const std::string& file) {
  for (const auto& finding : findings) {
    if (finding.kind == logs::Finding::Kind::kFatal) {
      const bool named = finding.sentence.starts_with(file + ": ");
      throw harness::FixtureError(
          {.file = file}, named ? finding.sentence.substr(file.size() + 2) : finding.sentence,
          "a log that can be read");
    }
  }
}

void refuse(const LogFile& log, std::size_t row, std::string given, std::string allowed) {
  throw harness::FixtureError(
      {.file = log.path, .line = row < log.table.rows() ? log.table.line[row] : 0},
      std::move(given), std::move(allowed));
}

LogFile read_log_file(const std::filesystem::path& path, const std::string& axis) {
  LogFile log{.path = path.string(), .table = {}};
  if (!std::filesystem::is_regular_file(path)) {
    throw harness::FixtureError({.file = log.path}, "cannot be read",
                                "a run folder, a data log or a file of CSV, MAT or MCAP");
  }
  const auto datalog = logs::find_datalog(path, axis);
  if (!datalog.wrong.empty()) {
    throw harness::FixtureError({.file = log.path}, datalog.wrong, "a whole data log of the axis");
  }
  log.is_datalog = datalog.is_datalog;
  logs::Findings findings;
  log.table = log.is_datalog ? logs::read_csv_table(path, findings, datalog.lines)
                             : logs::read_table(path, findings);
  refuse_fatal(findings, log.path);
  if (log.table.bad_rows > 0) {
    throw harness::FixtureError({.file = log.path, .line = log.table.first_bad_line},
                                fmt::format("{} cells", log.table.first_bad_cells),
                                fmt::format("{}, as in the header", log.table.names.size()));
  }
  return log;
}

const std::vector<double>& column_of(const LogFile& log, const std::string& name) {
  const auto* column = log.table.find(name);
  if (column == nullptr) {
    throw harness::FixtureError({.file = log.path}, "no column '" + name + "'",
                                fmt::format("one of: {}; name others with --columns MAP.toml",
                                            fmt::join(log.table.names, " ")));
  }
  for (std::size_t row = 0; row < column->size(); ++row) {
    if (!std::isfinite((*column)[row])) {
      refuse(log, row, fmt::format("column {}: no number", name), "a finite number");
    }
  }
  return *column;
}

}  // namespace towbench::study::procedures
