#include "harness/experiment/reference_table.h"

#include <algorithm>
#include <cmath>
#include <string>
#include <utility>

// Boost 1.74 calls isnan without a namespace, and finds it in the C header only.
// clang-format off
#include <math.h>
#include <boost/math/interpolators/pchip.hpp>
// clang-format on
#include <fmt/format.h>

#include "harness/files/csv_table.h"
#include "harness/files/regular_file.h"

namespace towbench::harness {
namespace {

constexpr std::uint64_t kLargestTable_bytes = 64U << 20U;
constexpr std::size_t kFewestRows = 4;  // what the interpolation takes
constexpr double kShortestStep_s = 1e-6;
constexpr double kFarthest_m = 1000;
constexpr double kFastest_m_per_s = 100;
constexpr const char* kColumns = "the columns time_s,position_m, with a number in each row";

// A person's last row without its end is a row too.
std::string with_last_end(std::string_view text) {
  return text.empty() || text.ends_with('\n') ? std::string(text) : std::string(text) + '\n';
}

CsvTable columns_of(std::string_view text, const std::filesystem::path& path) {
  try {
    auto table = CsvTable::parse(with_last_end(text), path);
    if (table.names().size() != 2 || !table.has("time_s") || !table.has("position_m")) {
      throw FixtureError({path.string(), 1, {}}, "another header", kColumns);
    }
    return table;
  } catch (const CsvError& error) {
    throw FixtureError({path.string()}, error.what(), kColumns);
  }
}

std::vector<double> slopes_of(const std::vector<double>& times_s,
                              const std::vector<double>& positions_m) {
  auto times = times_s;
  auto positions = positions_m;
  constexpr double kAtRest = 0;  // it begins and ends in a hold
  const boost::math::interpolators::pchip<std::vector<double>> curve(
      std::move(times), std::move(positions), kAtRest, kAtRest);
  std::vector<double> slopes;
  slopes.reserve(times_s.size());
  for (const double time_s : times_s) {
    slopes.push_back(curve.prime(time_s));
  }
  return slopes;
}

}  // namespace

std::shared_ptr<const ReferenceTable> ReferenceTable::parse(std::string_view text,
                                                            const std::filesystem::path& path) {
  const auto columns = columns_of(text, path);
  const auto times = columns.column("time_s");
  const auto positions = columns.column("position_m");
  auto table = std::make_shared<ReferenceTable>();
  table->path_ = path;
  for (std::size_t i = 0; i < columns.rows(); ++i) {
    table->rows_.push_back({.time_s = times[i], .position_m = positions[i]});
  }
  table->check();
  const auto slopes = slopes_of({times.begin(), times.end()}, {positions.begin(), positions.end()});
  for (std::size_t i = 0; i < slopes.size(); ++i) {
    table->rows_[i].slope_m_per_s = slopes[i];
  }
  return table;
}

std::shared_ptr<const ReferenceTable> ReferenceTable::load(const std::filesystem::path& path,
                                                           const FixtureError::Place& named_at,
                                                           SourceFiles& sources) {
  auto text = read_regular_file(path, kLargestTable_bytes);
  if (const auto* refused = std::get_if<Unreadable>(&text)) {
    throw FixtureError(named_at, path.string() + ": " + refused->what,
                       "a CSV file of at most 64 MiB");
  }
  auto table = parse(std::get<std::string>(text), path);
  remember(sources, path, std::get<std::string>(std::move(text)));
  return table;
}

FixtureError ReferenceTable::wrong(std::size_t row, const char* column, double given,
                                   std::string allowed) const {
  constexpr std::size_t kHeader = 2;  // lines count from 1
  return FixtureError({path_.string(), row + kHeader, column}, fmt::format("{}", given),
                      std::move(allowed));
}

void ReferenceTable::check() const {
  if (rows_.size() < kFewestRows) {
    throw FixtureError({path_.string()}, fmt::format("{} rows", rows_.size()),
                       fmt::format("at least {}", kFewestRows));
  }
  for (std::size_t i = 0; i < rows_.size(); ++i) {
    const auto& row = rows_[i];
    if (!(std::fabs(row.position_m) <= kFarthest_m)) {
      throw wrong(i, "position_m", row.position_m, "a number within +-1000");
    }
    if (i == 0) {
      continue;
    }
    const auto& before = rows_[i - 1];
    const double step_s = row.time_s - before.time_s;
    if (!(step_s >= kShortestStep_s && row.time_s <= kLongestRun_s)) {
      throw wrong(i, "time_s", row.time_s,
                  fmt::format("a time behind {}, that of the row before, and at most 86400",
                              before.time_s));
    }
    const double speed = (row.position_m - before.position_m) / step_s;
    if (!(std::fabs(speed) <= kFastest_m_per_s)) {
      throw wrong(i, "position_m", row.position_m,
                  fmt::format("at most 100 m/s from the row before; this is {:.4g} m/s", speed));
    }
  }
  if (rows_.front().time_s != 0 || rows_.front().position_m != 0) {
    throw FixtureError({path_.string(), 2, {}},
                       fmt::format("{},{}", rows_.front().time_s, rows_.front().position_m),
                       "0,0: a table begins where the axis stands");
  }
}

void ReferenceTable::require_within(double min_m, double max_m) const {
  for (std::size_t i = 0; i < rows_.size(); ++i) {
    if (rows_[i].position_m < min_m || rows_[i].position_m > max_m) {
      throw wrong(i, "position_m", rows_[i].position_m,
                  fmt::format("{:.4g} to {:.4g}, between the hard ends from where the axis stands",
                              min_m, max_m));
    }
  }
}

ReferencePoint ReferenceTable::at(double time_s) const noexcept {
  const auto next = std::upper_bound(rows_.begin() + 1, rows_.end() - 1, time_s,
                                     [](double t, const Row& row) { return t < row.time_s; });
  const Row& from = *(next - 1);
  const Row& to = *next;
  const double step_s = to.time_s - from.time_s;
  const double s = (time_s - from.time_s) / step_s;
  const double slope = (to.position_m - from.position_m) / step_s;
  // Newton's form of the cubic with these values and slopes at both ends.
  const double square = (slope - from.slope_m_per_s) * step_s;
  const double cube = (from.slope_m_per_s + to.slope_m_per_s - 2 * slope) * step_s;
  return {from.position_m + s * (from.slope_m_per_s * step_s + s * (square + (s - 1) * cube)),
          from.slope_m_per_s + s * (2 * square + (3 * s - 2) * cube) / step_s,
          (2 * square + (6 * s - 2) * cube) / (step_s * step_s)};
}

}  // namespace towbench::harness
