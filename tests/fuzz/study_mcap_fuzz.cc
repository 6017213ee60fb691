// Any bytes behind MCAP's first eight: a table whose columns are equally long, or a finding.
#include <cstdint>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <string>

#include <unistd.h>

#include "study/logs/mcap_records.h"
#include "study/logs/mcap_table.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace towbench::study::logs;
  static const auto path = std::filesystem::temp_directory_path() /
                           ("towbench_fuzz_" + std::to_string(getpid()) + ".mcap");
  const std::string_view bytes(reinterpret_cast<const char*>(data), size);
  std::ofstream(path, std::ios::binary | std::ios::trunc)
      << (bytes.starts_with(kMcapMagic) ? "" : kMcapMagic) << bytes;
  Findings findings;
  const Table table = read_mcap_table(path, findings);
  for (const auto& column : table.columns) {
    if (column.size() != table.rows()) {
      std::abort();
    }
  }
  if (table.rows() == 0 && !is_fatal(findings)) {
    std::abort();
  }
  std::filesystem::remove(path);
  return 0;
}
