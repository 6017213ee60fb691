// What a person brings to the command line: a plant file, logs as text, and the answer that comes
// back from the program itself.
#pragma once

#include <filesystem>
#include <functional>
#include <string>

#include <nlohmann/json.hpp>

#include "tests/study/diagnose/generator/hidden_axis.h"
#include "tests/support/program_output.h"

namespace towbench::tests {

// The bench's columns as CSV: time_s, y_reference_m where there is one, y_count, y_duty_pct.
[[nodiscard]] std::string csv_of(const HiddenAxis& axis, const HiddenLog& log);

// The header and the rows that are kept; the first row below the header is 1.
[[nodiscard]] std::string rows_where(const std::string& csv,
                                     const std::function<bool(std::size_t)>& keeps);

class BroughtCase {
 public:
  // The plant file states the axis without what is hidden in it.
  explicit BroughtCase(const HiddenAxis& axis = {});
  BroughtCase(const BroughtCase&) = delete;
  BroughtCase& operator=(const BroughtCase&) = delete;
  ~BroughtCase();

  [[nodiscard]] const std::filesystem::path& folder() const noexcept { return folder_; }
  [[nodiscard]] std::filesystem::path out() const { return folder_ / "found"; }
  std::filesystem::path write(const std::string& name, const std::string& text) const;
  // The command that `diagnose` runs; `arguments` name logs by their file names in the folder.
  [[nodiscard]] std::string command(const std::string& arguments) const;
  [[nodiscard]] ProgramOutput diagnose(const std::string& arguments) const;
  [[nodiscard]] ProgramOutput diagnose_without_model(const std::string& arguments) const;
  // diagnosis.json of the last one.
  [[nodiscard]] nlohmann::json answer() const;

 private:
  [[nodiscard]] std::string without_model(const std::string& arguments) const;

  std::filesystem::path folder_;
};

// Every name in an answer, classes as "a~b", sorted and parted by blanks.
[[nodiscard]] std::string names_in(const nlohmann::json& answer);

}  // namespace towbench::tests
