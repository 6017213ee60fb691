// The run report: one HTML file that needs nothing but a browser.
//
// Everything on the page comes from the run folder (docs/reference/run-folder.md states its
// format), and the same folder gives the same bytes. What it claims is first held against its
// hashes and its rows (agreement.h). What is missing, cut short or contradictory is said in words
// on the page; it never looks like a pass.
#pragma once

#include <filesystem>
#include <span>
#include <string>
#include <vector>

#include <tl/expected.hpp>

namespace towbench::harness {

struct WrittenReport {
  std::filesystem::path page;
  // What the folders say of themselves that is not so; a page about such a one is INVALID.
  std::vector<std::string> contradictions;
};
// Or an English sentence saying why there is no page.
using ReportResult = tl::expected<WrittenReport, std::string>;

// Writes `run_folder`/report.html, by rename, so that a reader never meets half a page.
// A folder with missing or damaged files still gives a page; a missing folder is an error.
[[nodiscard]] ReportResult write_report(const std::filesystem::path& run_folder);

// Several runs on one page: a summary table, then every run as on its own page. Refuses an empty
// list: a page about nothing must not exist.
[[nodiscard]] ReportResult write_combined_report(std::span<const std::filesystem::path> run_folders,
                                                 const std::filesystem::path& output_html);

}  // namespace towbench::harness
