// A quantity read off measurements: value, 95 % interval, unit, and what it rests on.
//
// Names of quantities are those of the plant fixture's keys where there is one
// (`inertia_kg_m2`, `coulomb_friction_Nm`, ...). SI; motor side unless the name says otherwise.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include <nlohmann/json_fwd.hpp>

namespace towbench::study::identify {

struct Estimate {
  std::string quantity;  // ends in its unit, as keys of fixtures do
  std::string axis;      // "y", "x"; empty: of the whole machine
  double value = 0;
  double low = 0;  // 95 % interval, both ends finite, low <= value <= high
  double high = 0;
  std::string unit;
  std::string rests_on;        // one sentence: which data, which assumptions
  std::string procedure;       // experiment id, EXP-OL-2
  std::optional<double> at{};  // of a map: position in m or speed in m/s, as the quantity says
  std::string no_interval{};   // why no interval is stated: low and high are then the value

  [[nodiscard]] double half_width() const noexcept { return 0.5 * (high - low); }
};

using Estimates = std::vector<Estimate>;

// The last one of that quantity and axis that is no point of a map; null when there is none.
[[nodiscard]] const Estimate* find(const Estimates& estimates, std::string_view quantity,
                                   std::string_view axis) noexcept;

// Value +- 1.96 standard errors.
[[nodiscard]] Estimate with_standard_error(Estimate estimate, double standard_error);

// Without an interval, for that reason.
[[nodiscard]] Estimate withheld(Estimate estimate, std::string reason);

// Schema `towbench/estimates/1`.
[[nodiscard]] nlohmann::json to_json(const Estimates& estimates);
// Throws nlohmann::json::exception.
[[nodiscard]] Estimates estimates_from_json(const nlohmann::json& json);

// Writes `path` by rename. Throws std::runtime_error.
void write_estimates(const std::filesystem::path& path, const Estimates& estimates);

}  // namespace towbench::study::identify
