#include <algorithm>
#include <cmath>
#include <limits>

#include "harness/report/plot_table.h"

namespace towbench::harness::report {
namespace {

// Appends the extremes of values[begin, end) in the order in which they occurred.
void append_extremes(const std::vector<double>& values, std::size_t begin, std::size_t end,
                     std::vector<double>& thin) {
  std::size_t smallest = end;
  std::size_t largest = end;
  for (std::size_t i = begin; i < end; ++i) {
    if (std::isnan(values[i])) {
      continue;
    }
    smallest = smallest == end || values[i] < values[smallest] ? i : smallest;
    largest = largest == end || values[i] > values[largest] ? i : largest;
  }
  if (smallest == end) {
    thin.insert(thin.end(), 2, std::numeric_limits<double>::quiet_NaN());
    return;
  }
  thin.push_back(values[std::min(smallest, largest)]);
  thin.push_back(values[std::max(smallest, largest)]);
}

}  // namespace

PlotTable thinned(const PlotTable& table, std::size_t max_rows) {
  if (table.rows <= max_rows || table.columns.empty()) {
    return table;
  }
  PlotTable thin = table;
  const std::size_t buckets = std::max<std::size_t>(max_rows / 2, 1);
  // At least 3, or thinning would not shorten anything.
  const std::size_t width = std::max<std::size_t>((table.rows + buckets - 1) / buckets, 3);
  thin.rows_per_bucket = width;
  for (std::size_t c = 0; c < table.columns.size(); ++c) {
    const std::vector<double>& values = table.columns[c].values;
    std::vector<double>& kept = thin.columns[c].values;
    kept.clear();
    for (std::size_t begin = 0; begin + 1 < table.rows; begin += width) {
      const std::size_t end = std::min(begin + width, table.rows);
      if (c == 0) {  // time: the bucket's start and middle, so that it stays strictly increasing
        kept.push_back(values[begin]);
        kept.push_back(values[begin + std::max<std::size_t>((end - begin) / 2, 1)]);
      } else {
        append_extremes(values, begin, end, kept);
      }
    }
  }
  thin.rows = thin.columns[0].values.size();
  return thin;
}

}  // namespace towbench::harness::report
