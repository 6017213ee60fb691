#include "study/diagnose/run_reader.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include "study/diagnose/log_columns.h"
#include "study/diagnose/position_jump.h"
#include "study/diagnose/time_grid.h"

namespace towbench::study::diagnose {
namespace {

// The smallest step between values that differ, when all differences are multiples of it; else 0.
double step_of(const std::vector<double>& column, const std::vector<std::size_t>& rows) {
  std::vector<double> steps;
  double low = column[rows.front()];
  double high = low;
  for (std::size_t j = 1; j < rows.size(); ++j) {
    low = std::min(low, column[rows[j]]);
    high = std::max(high, column[rows[j]]);
    steps.push_back(std::abs(column[rows[j]] - column[rows[j - 1]]));
  }
  double step = 0;
  for (const double d : steps) {
    step = d > 1e-9 * (high - low) && (step == 0 || d < step) ? d : step;
  }
  const auto off = std::count_if(steps.begin(), steps.end(), [&](double d) {
    return step > 0 && std::abs(d / step - std::round(d / step)) > 0.02;
  });
  return off * 50 > std::ssize(rows) ? 0 : step;
}

}  // namespace

Run make_run(const logs::Table& table, const logs::ColumnMap& map, std::string name,
             logs::Findings& findings) {
  Run run;
  run.name = std::move(name);
  const LogColumns columns = find_columns(table, map, run.name, findings);
  if (is_fatal(findings)) {
    return run;
  }
  const TimeGrid grid(table, columns, map.time_scale_s, run.name, findings);
  if (is_fatal(findings)) {
    return run;
  }
  run.period_s = grid.period_s();
  run.start_s = grid.start_s();
  run.missing = grid.missing();
  run.position_m = grid.resampled(*columns.position, map.position_scale_m);
  run.input_N = grid.resampled(*columns.input, map.input_scale_N);
  if (columns.reference != nullptr) {
    // The reference is in metres whatever the position counts in, unless both come from one map.
    run.reference_m =
        grid.resampled(*columns.reference, map.position_is_count ? 1.0 : map.position_scale_m);
  }
  if (columns.temperature != nullptr) {
    run.temperature_K = grid.resampled(*columns.temperature, 1);
  }
  for (std::size_t i = 0; i < columns.others.size(); ++i) {
    const logs::OtherColumn& other = map.others[i];
    run.others.push_back(
        {grid.resampled(*columns.others[i], other.position_scale_m), other.rotary});
  }
  if (map.position_is_count) {
    run.position_m.array() += 0.5 * map.position_scale_m;
  }
  join_position_jumps(run, findings);
  run.resolution_m = std::abs(map.position_scale_m) * step_of(*columns.position, columns.rows);
  if (run.resolution_m == 0 && map.position_is_count) {
    run.resolution_m = std::abs(map.position_scale_m);
  }
  run.input_step_N = std::abs(map.input_scale_N) * step_of(*columns.input, columns.rows);
  return run;
}

}  // namespace towbench::study::diagnose
