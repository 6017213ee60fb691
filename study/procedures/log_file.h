// A log of any format, for estimators that take none with a flaw: what is wrong is a FixtureError
// that names file and line.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "study/logs/finding.h"
#include "study/logs/table.h"

namespace towbench::study::procedures {

struct LogFile {
  std::string path;  // as messages name it
  logs::Table table;
  bool is_datalog = false;  // what BBMC prints of `axis` in a console's text
};

[[nodiscard]] LogFile read_log_file(const std::filesystem::path& path, const std::string& axis);

// Each cell is a finite number.
[[nodiscard]] const std::vector<double>& column_of(const LogFile& log, const std::string& name);

// `row` past the last: the file as a whole.
[[noreturn]] void refuse(const LogFile& log, std::size_t row, std::string given,
                         std::string allowed);
// Throws for the first fatal finding.
void refuse_fatal(const logs::Findings& findings, const std::string& file);

}  // namespace towbench::study::procedures
