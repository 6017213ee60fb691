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

ReportResult write_by_rename(const fs::path& output, const std::string& page) {
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
  return output;
}

}  // namespace

ReportResult write_report(const fs::path& run_folder) {
  std::error_code error;
  if (!fs::is_directory(run_folder, error)) {
    return failure("no run folder at " + run_folder.string());
  }
  return write_by_rename(run_folder / "report.html",
                         report::run_page(report::read_run(run_folder)));
}

ReportResult write_combined_report(std::span<const fs::path> run_folders,
                                   const fs::path& output_html) {
  if (run_folders.empty()) {
    return failure("a combined report needs at least one run folder");
  }
  std::vector<report::RunContents> runs;
  for (const fs::path& folder : run_folders) {
    std::error_code error;
    if (!fs::is_directory(folder, error)) {
      return failure("no run folder at " + folder.string());
    }
    runs.push_back(report::read_run(folder));
  }
  return write_by_rename(output_html, report::combined_page(runs));
}

}  // namespace towbench::harness
