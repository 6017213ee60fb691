#include "harness/files/csv_row.h"

#include <charconv>
#include <system_error>

namespace towbench::harness {
namespace {

std::string_view without(std::string_view padding, std::string_view cell) {
  const auto first = cell.find_first_not_of(padding);
  return first == std::string_view::npos
             ? std::string_view{}
             : cell.substr(first, cell.find_last_not_of(padding) - first + 1);
}

}  // namespace

void split_csv_row(std::string_view line, char separator, std::string_view padding,
                   std::vector<std::string_view>& cells) {
  cells.clear();
  for (auto end = line.find(separator); end != std::string_view::npos; end = line.find(separator)) {
    cells.push_back(without(padding, line.substr(0, end)));
    line.remove_prefix(end + 1);
  }
  cells.push_back(without(padding, line));
}

std::optional<double> csv_number(std::string_view cell) noexcept {
  const bool plus = cell.starts_with('+') && !cell.starts_with("+-");
  const char* const end = cell.data() + cell.size();
  double value = 0;
  const auto [stop, error] = std::from_chars(cell.data() + (plus ? 1 : 0), end, value);
  return error == std::errc{} && stop == end ? std::optional(value) : std::nullopt;
}

}  // namespace towbench::harness
