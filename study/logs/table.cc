#include "study/logs/table.h"

#include <algorithm>

namespace towbench::study::logs {

const std::vector<double>* Table::find(std::string_view name) const noexcept {
  const auto at = std::find(names.begin(), names.end(), name);
  return at == names.end() ? nullptr : &columns[static_cast<std::size_t>(at - names.begin())];
}

std::size_t Table::count(std::string_view name) const noexcept {
  return static_cast<std::size_t>(std::count(names.begin(), names.end(), name));
}

}  // namespace towbench::study::logs
