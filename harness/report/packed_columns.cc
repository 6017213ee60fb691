#include "harness/report/packed_columns.h"

#include <algorithm>
#include <cmath>
#include <cstdint>

#include "harness/report/base64.h"

namespace towbench::harness::report {
namespace {

struct Scaling {
  unsigned bits = 8;
  double offset = 0;
  double scale = 1;
};

std::uint64_t missing_code(unsigned bits) {
  return (std::uint64_t{1} << bits) - 1;
}

Scaling scaling_for(const std::vector<double>& values) {
  double smallest = 0;
  double largest = 0;
  bool any = false;
  bool integers = true;
  for (const double value : values) {
    if (!std::isnan(value)) {
      smallest = any ? std::min(smallest, value) : value;
      largest = any ? std::max(largest, value) : value;
      any = true;
      integers = integers && std::floor(value) == value;
    }
  }
  const double range = largest - smallest;
  if (range == 0) {
    return {8, smallest, 1};
  }
  for (const unsigned bits : {8U, 16U, 32U}) {
    if (integers && range < static_cast<double>(missing_code(bits))) {
      return {bits, smallest, 1};
    }
  }
  return {32, smallest, range / static_cast<double>(missing_code(32) - 1)};
}

}  // namespace

nlohmann::json packed(const std::string& name, const std::vector<double>& values) {
  const Scaling scaling = scaling_for(values);
  const auto top = static_cast<double>(missing_code(scaling.bits) - 1);
  std::vector<std::uint8_t> bytes;
  bytes.reserve(values.size() * scaling.bits / 8);
  for (const double value : values) {
    std::uint64_t code = missing_code(scaling.bits);
    if (!std::isnan(value)) {
      const double steps = (value - scaling.offset) / scaling.scale;
      code = static_cast<std::uint64_t>(std::clamp(std::floor(steps + 0.5), 0.0, top));
    }
    for (unsigned shift = 0; shift < scaling.bits; shift += 8) {
      bytes.push_back(static_cast<std::uint8_t>((code >> shift) & 0xFFU));
    }
  }
  return {{"name", name},
          {"bits", scaling.bits},
          {"offset", scaling.offset},
          {"scale", scaling.scale},
          {"data", base64(bytes)}};
}

nlohmann::json packed(const PlotTable& table, std::size_t max_bytes) {
  // The worst case of a cell: 32 bits in base64.
  constexpr double kBytesPerCell = 4.0 * 4.0 / 3.0;
  const auto columns = static_cast<double>(std::max<std::size_t>(table.columns.size(), 1));
  const auto max_rows =
      static_cast<std::size_t>(static_cast<double>(max_bytes) / (kBytesPerCell * columns));
  const PlotTable drawn = thinned(table, std::max<std::size_t>(max_rows, 2));
  nlohmann::json columns_json = nlohmann::json::array();
  for (const PlotColumn& column : drawn.columns) {
    columns_json.push_back(packed(column.name, column.values));
  }
  return {{"rows", drawn.rows},
          {"source_rows", drawn.source_rows},
          {"rows_per_bucket", drawn.rows_per_bucket},
          {"columns", std::move(columns_json)}};
}

}  // namespace towbench::harness::report
