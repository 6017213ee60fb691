#include "harness/diagnose/run_reader.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include <fmt/format.h>

#include "harness/diagnose/position_jump.h"

namespace towbench::harness::diagnose {
namespace {

constexpr std::size_t kFewestSamples = 400;
constexpr double kJitterShare = 0.05;  // of the period, rms, above which the user is told
constexpr double kMissingShare = 0.2;  // of the samples, above which the log is refused
constexpr double kLargestGapPeriods = 1.5;

void tell(Findings& findings, Finding::Kind kind, std::string name, std::string sentence) {
  findings.push_back({kind, std::move(name), std::move(sentence)});
}

double median(std::vector<double> values) {
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

struct Rows {
  std::vector<std::size_t> index;  // rows with numbers in every used column
  std::size_t refused = 0;
};

Rows usable_rows(const std::vector<const std::vector<double>*>& used) {
  Rows rows;
  for (std::size_t i = 0; i < used.front()->size(); ++i) {
    const bool finite = std::all_of(
        used.begin(), used.end(), [&](const auto* column) { return std::isfinite((*column)[i]); });
    if (finite) {
      rows.index.push_back(i);
    } else {
      ++rows.refused;
    }
  }
  return rows;
}

// The smallest step between values that differ, when all differences are multiples of it; else 0.
double step_of(const Eigen::VectorXd& x) {
  double step = 0;
  const double span = x.maxCoeff() - x.minCoeff();
  for (Eigen::Index i = 1; i < x.size(); ++i) {
    const double d = std::abs(x[i] - x[i - 1]);
    if (d > 1e-9 * span && (step == 0 || d < step)) {
      step = d;
    }
  }
  Eigen::Index off = 0;
  for (Eigen::Index i = 1; i < x.size() && step > 0; ++i) {
    const double d = (x[i] - x[i - 1]) / step;
    off += std::abs(d - std::round(d)) > 0.02 ? 1 : 0;
  }
  return off * 50 > x.size() ? 0 : step;
}

// Linear interpolation onto a uniform grid; marks what lies in a gap.
struct Grid {
  const std::vector<double>& time;
  const Rows& rows;
  double scale_s;
  double start_s;
  double period_s;
  Eigen::Index samples;

  Eigen::VectorXd resample(const std::vector<double>& column, double scale,
                           std::vector<char>* missing) const {
    Eigen::VectorXd out(samples);
    std::size_t j = 0;
    for (Eigen::Index k = 0; k < samples; ++k) {
      const double t = start_s + static_cast<double>(k) * period_s;
      while (j + 2 < rows.index.size() && time_at(j + 1) <= t) {
        ++j;
      }
      const double t0 = time_at(j);
      const double gap = time_at(j + 1) - t0;
      const double w = std::clamp((t - t0) / gap, 0.0, 1.0);
      out[k] = scale * ((1 - w) * column[rows.index[j]] + w * column[rows.index[j + 1]]);
      if (missing != nullptr) {
        (*missing)[static_cast<std::size_t>(k)] =
            gap > kLargestGapPeriods * period_s && w > 0.01 && w < 0.99 ? 1 : 0;
      }
    }
    return out;
  }
  [[nodiscard]] double time_at(std::size_t j) const { return scale_s * time[rows.index[j]]; }
};

// Uniform time stamps but for rounding: no interpolation, so counts stay counts.
bool is_uniform(const Grid& grid) {
  if (static_cast<std::size_t>(grid.samples) != grid.rows.index.size()) {
    return false;
  }
  for (std::size_t j = 0; j < grid.rows.index.size(); ++j) {
    const double ideal = grid.start_s + static_cast<double>(j) * grid.period_s;
    if (std::abs(grid.time_at(j) - ideal) > 0.01 * grid.period_s) {
      return false;
    }
  }
  return true;
}

double jitter_share(const Grid& grid) {
  double sum = 0;
  for (std::size_t j = 1; j < grid.rows.index.size(); ++j) {
    const double gap = (grid.time_at(j) - grid.time_at(j - 1)) / grid.period_s;
    const double off = gap - std::round(gap);
    sum += off * off;
  }
  return std::sqrt(sum / static_cast<double>(grid.rows.index.size()));
}

}  // namespace

Run make_run(const Table& table, const ColumnMap& map, std::string name, Findings& findings) {
  using Kind = Finding::Kind;
  Run run;
  run.name = std::move(name);
  std::vector<const std::vector<double>*> used;
  for (const auto* column : {&map.time, &map.position, &map.input}) {
    used.push_back(table.find(*column));
    if (used.back() == nullptr) {
      tell(findings, Kind::kFatal, "column_missing",
           fmt::format("{}: no column '{}'", run.name, *column));
      return run;
    }
  }
  const auto* reference = map.reference.empty() ? nullptr : table.find(map.reference);
  const auto* other = map.other_position.empty() ? nullptr : table.find(map.other_position);
  const Rows rows = usable_rows(used);
  if (table.bad_rows > 0) {
    tell(findings, Kind::kNote, "bad_rows",
         fmt::format("{}: {} rows left out, their cells are not as many as the header's", run.name,
                     table.bad_rows));
  }
  if (rows.refused > 0) {
    tell(findings, Kind::kNote, "not_a_number",
         fmt::format("{}: {} rows left out, time, position or input is not a number there",
                     run.name, rows.refused));
  }
  if (rows.index.size() < kFewestSamples) {
    tell(findings, Kind::kFatal, "too_short",
         fmt::format("{}: {} usable samples; at least {} are needed", run.name, rows.index.size(),
                     kFewestSamples));
    return run;
  }
  std::vector<double> gaps;
  for (std::size_t j = 1; j < rows.index.size(); ++j) {
    gaps.push_back(map.time_scale_s * ((*used[0])[rows.index[j]] - (*used[0])[rows.index[j - 1]]));
  }
  if (std::any_of(gaps.begin(), gaps.end(), [](double gap) { return gap <= 0; })) {
    tell(findings, Kind::kFatal, "time_not_rising",
         fmt::format("{}: time stands still or runs back; are two runs in one file?", run.name));
    return run;
  }
  const double typical = median(gaps);
  const double start = map.time_scale_s * (*used[0])[rows.index.front()];
  const double span = map.time_scale_s * (*used[0])[rows.index.back()] - start;
  const double intervals = std::round(span / typical);
  if (intervals > 4.0 * static_cast<double>(rows.index.size())) {
    tell(findings, Kind::kFatal, "missing_samples",
         fmt::format("{}: most of the time span has no samples", run.name));
    return run;
  }
  run.period_s = span / intervals;
  const Grid grid{*used[0], rows,         map.time_scale_s,
                  start,    run.period_s, static_cast<Eigen::Index>(intervals) + 1};
  run.missing.assign(static_cast<std::size_t>(grid.samples), 0);
  run.position_m = grid.resample(*used[1], map.position_scale_m, &run.missing);
  run.input_N = grid.resample(*used[2], map.input_scale_N, nullptr);
  if (reference != nullptr) {
    // The reference is in metres whatever the position counts in, unless both come from one map.
    run.reference_m =
        grid.resample(*reference, map.position_is_count ? 1.0 : map.position_scale_m, nullptr);
  }
  if (other != nullptr) {
    run.other_position_m = grid.resample(*other, map.other_position_scale_m, nullptr);
  }
  if (map.position_is_count) {
    run.position_m.array() += 0.5 * map.position_scale_m;
  }
  const bool uniform = is_uniform(grid);
  if (!uniform && jitter_share(grid) > kJitterShare) {
    tell(findings, Kind::kNote, "jittered_time",
         fmt::format("{}: time stamps jitter by {:.0f} % of the period; resampled at {:.6g} Hz",
                     run.name, 100 * jitter_share(grid), 1 / run.period_s));
  }
  const auto holes = static_cast<double>(std::count(run.missing.begin(), run.missing.end(), 1));
  if (holes > 0) {
    const double share = holes / static_cast<double>(grid.samples);
    tell(findings, share > kMissingShare ? Kind::kFatal : Kind::kNote, "missing_samples",
         fmt::format("{}: {:.1f} % of the samples are missing; they are left out of every test",
                     run.name, 100 * share));
  }
  if (run.position_m.maxCoeff() - run.position_m.minCoeff() <= 0) {
    tell(findings, Kind::kFatal, "constant_position",
         fmt::format("{}: '{}' never changes: dead encoder or wrong column", run.name,
                     map.position));
    return run;
  }
  if (run.input_N.maxCoeff() - run.input_N.minCoeff() <= 0) {
    tell(findings, Kind::kFatal, "constant_input",
         fmt::format("{}: '{}' never changes: dead channel or wrong column", run.name, map.input));
    return run;
  }
  join_position_jumps(run, findings);
  run.resolution_m = uniform ? step_of(run.position_m) : 0;
  if (run.resolution_m == 0 && map.position_is_count) {
    run.resolution_m = map.position_scale_m;
  }
  run.input_step_N = uniform ? step_of(run.input_N) : 0;
  return run;
}

}  // namespace towbench::harness::diagnose
