// tows.toml: which record holds which run of which tow experiment. `tow` writes one beside the run
// folders that it keeps; a person writes one for tows of another tank.
//
//   schema = 1
//   columns = "columns.toml"      of the logs below (foreign_log.h); none for run folders
//   [[tow]]
//   experiment = "EXP-1"          its id, and the run's name there
//   name = "in the water at 0.150 m/s"
//   folder = "EXP-1/2025..."      a run folder, or instead:
//   log = "a.csv"                 with force = "b.csv" when the force is logged apart,
//   steady_from_s = [2.0, 9.0]    and where the speed is steady, when the log has no reference
//   steady_to_s   = [6.0, 13.0]
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "core/bounded_vector.h"

namespace towbench::study {

inline constexpr const char* kTowListFile = "tows.toml";

struct ListedTow {
  std::string experiment;
  std::string name;
  std::string folder{};  // paths relative to the list
  std::string log{};
  std::string force{};  // empty: in the log
  core::BoundedVector<double, 16> steady_from_s{};
  core::BoundedVector<double, 16> steady_to_s{};
};

struct TowList {
  std::filesystem::path file;
  std::string columns;  // empty: none
  std::vector<ListedTow> tows;
};

// Throws FixtureError: no list, a tow twice, neither folder nor log, both, a log without columns.
[[nodiscard]] TowList read_tow_list(const std::filesystem::path& folder);

// Of run folders.
[[nodiscard]] std::string tow_list_toml(const std::vector<ListedTow>& tows);

}  // namespace towbench::study
