#include "harness/report/agreement.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <optional>
#include <utility>

#include <fmt/format.h>

#include "harness/judge/budget_checks.h"
#include "harness/metrics/run_data.h"
#include "harness/report/run_contents.h"

namespace towbench::harness::report {
namespace {

using Json = nlohmann::json;
using Sentences = std::vector<std::string>;
// By name and window.
using Values = std::map<std::pair<std::string, std::string>, MetricValue>;

const Json& elements_of(const Json& object, std::string_view key) {
  static const Json kNone = Json::array();
  const Json& value = member(object, key);
  return value.is_array() ? value : kNone;
}

core::PerAxis<AxisLimits> limits_in(const Json& result) {
  core::PerAxis<AxisLimits> limits;
  for (const auto axis : core::kAllAxes) {
    const Json& ends = member(member(result, "limits"), core::name_of(axis));
    const auto value = [&](const char* key) { return number_at(ends, key).value_or(0); };
    const Json& exists = member(ends, "exists");
    limits[axis] = {.exists = ends.is_object() && (!exists.is_boolean() || exists.get<bool>()),
                    .hall_min_m = value("hall_min_m"),
                    .hall_max_m = value("hall_max_m"),
                    .hard_min_m = value("hard_min_m"),
                    .hard_max_m = value("hard_max_m"),
                    .metres_per_count = value("metres_per_count")};
  }
  return limits;
}

std::vector<ResolvedWindow> windows_in(const Json& metrics) {
  std::vector<ResolvedWindow> windows;
  for (const Json& window : elements_of(metrics, "windows")) {
    const TimeSpan all;
    windows.push_back({text_at(window, "name"),
                       {number_at(window, "from_s").value_or(all.from_s),
                        number_at(window, "to_s").value_or(all.to_s)}});
  }
  return windows;
}

Values values_of(const RunData& data, const std::vector<ResolvedWindow>& windows) {
  Values values;
  for (const auto& measurement : measure(data, windows)) {
    values[{measurement.metric->name, measurement.window}] = measurement.value;
  }
  return values;
}

// JSON keeps every bit of a number; the slack is for another build's compiler.
bool is_same(double recorded, double computed) {
  constexpr double kRelative = 1e-9;
  return std::fabs(recorded - computed) <= kRelative * std::max(std::fabs(recorded), 1e-6);
}

// `claim` has a name, a window and a value. What claims no number claims nothing here.
void compare_value(const Json& claim, const char* file, const Values& values,
                   Sentences& contradictions) {
  const auto recorded = number_at(claim, "value");
  if (!recorded) {
    return;
  }
  const std::string name = text_at(claim, "name");
  const std::string window = text_at(claim, "window");
  const auto found = values.find({name, window});
  if (found == values.end()) {
    contradictions.push_back(fmt::format(
        "{} states {} over the window \"{}\", which the rows cannot show.", file, name, window));
  } else if (found->second.samples == 0 || !is_same(*recorded, found->second.value)) {
    contradictions.push_back(fmt::format(
        "{} says that {} is {:.6g}; the rows give {}.", file, name, *recorded,
        found->second.samples == 0 ? "no sample" : fmt::format("{:.6g}", found->second.value)));
  }
}

void compare_rows(const Json& result, const char* key, std::size_t found,
                  Sentences& contradictions) {
  const auto recorded = number_at(member(result, "rows"), key);
  if (!recorded || *recorded != static_cast<double>(found)) {
    contradictions.push_back(
        fmt::format("{}.csv has {} rows, result.json says {}.", key, found,
                    recorded ? fmt::format("{:.0f}", *recorded) : "nothing of them"));
  }
}

void check_against_limits(const Json& result, Sentences& contradictions) {
  for (const Json& check : elements_of(result, "checks")) {
    const auto value = number_at(check, "value");
    const auto min = number_at(check, "min");
    const auto max = number_at(check, "max");
    const bool demands = min || max;
    const bool met =
        value && std::isfinite(*value) && (!min || *value >= *min) && (!max || *value <= *max);
    if (text_at(check, "verdict") == "PASS" && demands && !met) {
      contradictions.push_back(fmt::format("The check {} is called PASS, but its value {}.",
                                           text_at(check, "name"),
                                           value ? "breaks its limit" : "is missing"));
    }
  }
}

// A run whose controller was killed on purpose is judged by its fault's requirements alone: it has
// no windows, and none of its checks is a metric.
void compute_again(const std::filesystem::path& folder, const Json& result, const Json& metrics,
                   Sentences& contradictions) {
  const auto windows = windows_in(metrics);
  Values values;
  if (!windows.empty()) {
    const auto data = load_run_data(folder, limits_in(result));
    compare_rows(result, "log", data.log.rows(), contradictions);
    compare_rows(result, "truth", data.truth.rows(), contradictions);
    values = values_of(data, windows);
  }
  for (const Json& metric : elements_of(metrics, "metrics")) {
    compare_value(metric, "metrics.json", values, contradictions);
  }
  for (const Json& check : elements_of(result, "checks")) {
    if (find_metric(text_at(check, "name")) != nullptr) {
      compare_value(check, "result.json", values, contradictions);
    }
  }
}

}  // namespace

Agreement agreement_of(const std::filesystem::path& folder, const Json& result,
                       const Json& metrics) {
  auto manifest = check_manifest(folder);
  Agreement agreement{manifest.origin, std::move(manifest.problems)};
  auto& contradictions = agreement.contradictions;
  if (text_at(result, "status") != "complete") {
    return agreement;
  }
  if (!manifest.present) {
    contradictions.emplace_back(
        "manifest.json is missing: nothing says that these are the files of that run.");
  }
  check_against_limits(result, contradictions);
  if (!metrics.is_object()) {
    contradictions.emplace_back("metrics.json, which a judged run has, cannot be read.");
  }
  if (contradictions.empty()) {
    try {
      compute_again(folder, result, metrics, contradictions);
    } catch (const std::exception& error) {
      contradictions.push_back(fmt::format("The record cannot be read again: {}.", error.what()));
    }
  }
  return agreement;
}

}  // namespace towbench::harness::report
