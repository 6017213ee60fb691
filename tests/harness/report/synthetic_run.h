// A run folder in the format of docs/reference/run-folder.md, made from formulas: what a report
// test can know exactly without running the bench.
#pragma once

#include <cstddef>
#include <filesystem>
#include <string>

#include <nlohmann/json.hpp>

namespace towbench::harness::test {

struct SyntheticRun {
  std::size_t rows = 9000;  // at 1 kHz; a circle of 0.2 m in 7 s from second 1 on
  std::string title = "Circle, 0.20 m in 7 s";
  std::string description = "Made from formulas for the report's own tests.";
  std::string console = "BBMC> run -circle\r\nrunning\nBBMC> ";
  std::string event_text = "soft limit";
  double error_peak_m = 4e-4;  // motor side, of y
};

// result.json of that run, to be changed by a test before it is written.
[[nodiscard]] nlohmann::json synthetic_result(const SyntheticRun& run);

// Writes the whole folder; `folder` is made.
void write_synthetic_run(const std::filesystem::path& folder, const SyntheticRun& run);
void write_synthetic_run(const std::filesystem::path& folder, const SyntheticRun& run,
                         const nlohmann::json& result);

// Exact position of a row: reference, then motor side, then carriage, of y in metres.
struct SyntheticRow {
  double time_s = 0;
  double reference_m = 0;
  double position_m = 0;
  double carriage_m = 0;
};
[[nodiscard]] SyntheticRow synthetic_y(const SyntheticRun& run, std::size_t row);

[[nodiscard]] std::string read_text(const std::filesystem::path& path);
void write_text(const std::filesystem::path& path, const std::string& text);

}  // namespace towbench::harness::test
