// Columns of numbers as compact JSON: scaled unsigned integers, little-endian, in base64.
//
// 32-bit integers over the column's own range resolve 2.3e-10 of that range. A 32-bit float would
// not do: at 2.68 m it steps by 0.24 µm, a tenth of an encoder count, which would show in the
// error.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include <nlohmann/json.hpp>

#include "harness/report/plot_table.h"

namespace towbench::harness::report {

// {"name": ..., "bits": 8|16|32, "offset": o, "scale": s, "data": base64}: value = o + s x integer,
// and the integer with all bits set stands for a missing value. Columns of integers come out exact.
[[nodiscard]] nlohmann::json packed(const std::string& name, const std::vector<double>& values);

// The whole table; thinned first when it would take more than `max_bytes` of the page.
[[nodiscard]] nlohmann::json packed(const PlotTable& table, std::size_t max_bytes);

}  // namespace towbench::harness::report
