#include "study/logs/read_table.h"

#include <array>
#include <fstream>
#include <string_view>

#include "study/logs/csv_table.h"
#include "study/logs/mat_table.h"
#include "study/logs/mcap_table.h"

namespace towbench::study::logs {

Table read_table(const std::filesystem::path& path, Findings& findings) {
  std::array<char, 16> first{};
  if (std::filesystem::is_regular_file(path)) {
    std::ifstream(path, std::ios::binary).read(first.data(), first.size());
  }
  const std::string_view head(first.data(), first.size());
  if (is_mcap(head)) {
    return read_mcap_table(path, findings);
  }
  if (is_mat(head)) {
    return read_mat_table(path, findings);
  }
  return read_csv_table(path, findings);
}

}  // namespace towbench::study::logs
