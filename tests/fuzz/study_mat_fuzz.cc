// Any bytes as a MAT file, read in the process of its own: a table or a finding, and the caller
// lives.
#include <cstdint>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <string>

#include <unistd.h>

#include "study/logs/mat_table.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace towbench::study::logs;
  static const auto path = std::filesystem::temp_directory_path() /
                           ("towbench_fuzz_" + std::to_string(getpid()) + ".mat");
  std::ofstream(path, std::ios::binary | std::ios::trunc)
      << std::string_view(reinterpret_cast<const char*>(data), size);
  Findings findings;
  const Table table = read_mat_table(path, findings);
  for (const auto& column : table.columns) {
    if (column.size() != table.rows()) {
      std::abort();
    }
  }
  if (table.names.empty() && !is_fatal(findings)) {
    std::abort();
  }
  std::filesystem::remove(path);
  return 0;
}
