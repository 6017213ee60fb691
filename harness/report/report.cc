#include "harness/report/report.h"

#include <fstream>
#include <system_error>
#include <utility>
#include <vector>

#include "harness/report/page.h"
#include "harness/report/run_contents.h"

namespace towbench::harness {
namespace {

namespace fs = std::filesystem;

tl::unexpected<std::string> failure(std::string sentence) {
  return tl::unexpected<std::string>(std::move(sentence));
}

ReportResult write_by_rename(const fs::path& output, const std::string& page,
                             std::vector<std::string> contradictions) {
  fs::path unfinished = output;
  unfinished += ".part";
  {
    std::ofstream file(unfinished, std::ios::binary | std::ios::trunc);
    file.write(page.data(), static_cast<std::streamsize>(page.size()));
    file.flush();
    if (!file) {
      return failure("cannot write " + unfinished.string());
    }
  }
  std::error_code error;
  fs::rename(unfinished, output, error);
  if (error) {
    return failure("cannot rename " + unfinished.string() + ": " + error.message());
  }
  return WrittenReport{output, std::move(contradictions)};
}

// A folder without a readable result contradicts its being a run folder.
std::vector<std::string> untrue_of(const report::RunContents& run) {
  auto sentences = run.contradictions;
  if (!run.result.is_object()) {
    sentences.emplace_back("result.json cannot be read.");
  }
  return sentences;
}

}  // namespace

ReportResult write_report(const fs::path& run_folder) {
  std::error_code error;
  if (!fs::is_directory(run_folder, error)) {
    return failure("no run folder at " + run_folder.string());
  }
  const auto run = report::read_run(run_folder);
  return write_by_rename(run_folder / "report.html", report::run_page(run), untrue_of(run));
}

ReportResult write_combined_report(std::span<const fs::path> run_folders,
                                   const fs::path& output_html) {
  if (run_folders.empty()) {
    return failure("a combined report needs at least one run folder");
  }
  std::vector<report::RunContents> runs;
  std::vector<std::string> contradictions;
  for (const fs::path& folder : run_folders) {
    std::error_code error;
    if (!fs::is_directory(folder, error)) {
      return failure("no run folder at " + folder.string());
    }
    runs.push_back(report::read_run(folder));
    for (const std::string& sentence : untrue_of(runs.back())) {
      contradictions.push_back(folder.string() + ": " + sentence);
    }
  }
  return write_by_rename(output_html, report::combined_page(runs), std::move(contradictions));
}

}  // namespace towbench::harness
