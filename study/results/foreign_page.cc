#include <algorithm>
#include <array>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <map>
#include <utility>

#include <fmt/format.h>

#include "harness/fixtures/fixture_paths.h"
#include "study/procedures/kept_outcome.h"
#include "study/results/identification_set.h"

namespace towbench::study {
namespace {

struct Column {
  const char* head;
  const char* quantity;
};
using Table = std::vector<Column>;

// Saturation speed and smallest command are seen, not modelled: what they should be has no formula
// on a foreign machine.
const std::array<std::pair<const char*, Table>, 3> kTables{{
    {"Inertia and friction",
     {{"J", "inertia_kg_m2"},
      {"B, pulses", "viscous_friction_Nm_s_per_rad"},
      {"B, steady", "steady_viscous_Nm_s_per_rad"},
      {"J/B, coasts", "mechanical_time_constant_s"},
      {"C, pulses", "coulomb_friction_Nm"},
      {"C, steady", "sliding_friction_Nm"}}},
    {"Drive, transmission, switches",
     {{"K_T", "torque_constant_Nm_per_A"},
      {"K_amp", "amplifier_gain_A_per_V"},
      {"transmission mode", "transmission_resonance_Hz"},
      {"its damping", "transmission_damping_ratio"},
      {"break-away", "breakaway_Nm"},
      {"switches apart", "hall_distance_m"}}},
    {"Friction law",
     {{"Stribeck speed, pulses", "stribeck_speed_rad_per_s"},
      {"the same, EXP-CL-1", "map_stribeck_rad_per_s"},
      {"B, EXP-CL-1", "map_viscous_Nm_s_per_rad"},
      {"C, EXP-CL-1", "map_coulomb_Nm"}}},
}};

struct Cell {
  std::size_t estimates = 0;
  std::size_t covered = 0;
  std::size_t withheld = 0;
  double error_sum_pct = 0;
  double half_sum_pct = 0;

  void add(const Recovery& each) {
    ++estimates;
    covered += each.covered ? 1U : 0U;
    error_sum_pct += each.error_pct;
    half_sum_pct += 0.5 * each.width_pct;
  }
  void add(const Cell& other) {
    estimates += other.estimates;
    covered += other.covered;
    withheld += other.withheld;
    error_sum_pct += other.error_sum_pct;
    half_sum_pct += other.half_sum_pct;
  }
  [[nodiscard]] bool holds() const {
    return static_cast<double>(covered) >= 0.95 * static_cast<double>(estimates);
  }
  [[nodiscard]] std::string text() const {
    if (estimates == 0) {
      return "none";
    }
    const auto n = static_cast<double>(estimates);
    const auto told = fmt::format("{}/{}, {:+.2g} +-{:.2g}", covered, estimates, error_sum_pct / n,
                                  half_sum_pct / n);
    return holds() ? told : "**" + told + "**";
  }
};

// By structure and quantity, both axes and all seeds together.
using Cells = std::map<std::pair<std::size_t, std::string>, Cell>;

Cells cells_of(const std::vector<SetRun>& runs) {
  Cells cells;
  for (const auto& run : runs) {
    for (const auto& each : run.recoveries) {
      cells[{run.machine, each.estimate.quantity}].add(each);
    }
    for (const auto& each : run.withheld) {
      ++cells[{run.machine, each.substr(0, each.find(' '))}].withheld;
    }
  }
  return cells;
}

std::string structures_table(const IdentificationSet& set) {
  std::string text = "| structure | what differs | size by |\n| --- | --- | --- |\n";
  for (const auto& each : set.structures) {
    text += fmt::format("| `{}` | {} | {} |\n", each.name, each.what, each.source);
  }
  return text;
}

// What differs from the shipped settings, in one line; empty: nothing.
std::string other_settings(const IdentificationSet& set) {
  const auto shipped = harness::fixtures_directory() / "identification";
  std::string text;
  for (const auto& file : std::filesystem::directory_iterator(set.settings)) {
    const auto name = file.path().filename();
    if (procedures::file_fingerprint(file.path()) == procedures::file_fingerprint(shipped / name)) {
      continue;
    }
    text += fmt::format("{}`{}`:", text.empty() ? "" : "; ", name.string());
    std::ifstream stream(file.path());
    bool values = false;
    for (std::string line; std::getline(stream, line);) {
      text += values && !line.empty() ? fmt::format(" {},", line) : std::string();
      values = values || line == "[settings]";
    }
  }
  return text.empty() ? text : "Settings other than the shipped ones: " + text + "\n\n";
}

std::string table_of(const IdentificationSet& set, const Cells& cells, const char* title,
                     const Table& columns) {
  std::string text = fmt::format("\n## {}\n\n| structure |", title);
  std::string rule = "\n| --- |";
  for (const auto& column : columns) {
    text += fmt::format(" {} |", column.head);
    rule += " --- |";
  }
  text += rule + "\n";
  std::map<std::string, Cell> all;
  for (std::size_t i = 0; i < set.structures.size(); ++i) {
    text += fmt::format("| `{}` |", set.structures[i].name);
    for (const auto& column : columns) {
      const auto found = cells.find({i, column.quantity});
      const auto cell = found == cells.end() ? Cell{} : found->second;
      text += fmt::format(" {} |", cell.text());
      if (i > 0) {
        all[column.quantity].add(cell);
      }
    }
    text += "\n";
  }
  text += "| all foreign |";
  for (const auto& column : columns) {
    text += fmt::format(" {} |", all[column.quantity].text());
  }
  return text + "\n";
}

// Each experiment or quantity once a structure, with the first of its reasons.
std::string reasons(const IdentificationSet& set, const std::vector<SetRun>& runs,
                    std::vector<std::string> SetRun::*which) {
  std::string text;
  for (std::size_t i = 0; i < set.structures.size(); ++i) {
    std::map<std::string, std::pair<std::size_t, std::string>> times;
    for (const auto& run : runs) {
      for (const auto& each : run.machine == i ? run.*which : std::vector<std::string>{}) {
        const auto end = std::min(each.size(), each.find(':'));
        auto& [count, first] = times[each.substr(0, end)];
        first = count++ == 0 ? each.substr(end) : first;
      }
    }
    for (const auto& [what, counted] : times) {
      text += fmt::format("- `{}`: {} ({} times){}\n", set.structures[i].name, what, counted.first,
                          counted.second);
    }
  }
  return text;
}

// Of everything the tables hold: structures of which 95 % of the intervals given hold the truth.
std::string summary(const IdentificationSet& set, const Cells& cells) {
  std::size_t holding = 0;
  Cell whole;
  for (std::size_t i = 1; i < set.structures.size(); ++i) {
    Cell own;
    for (const auto& [title, columns] : kTables) {
      for (const auto& column : columns) {
        const auto found = cells.find({i, column.quantity});
        own.add(found == cells.end() ? Cell{} : found->second);
      }
    }
    holding += own.estimates > 0 && own.holds() ? 1U : 0U;
    whole.add(own);
  }
  return fmt::format(
      "\nOf {} foreign structures {} have at least 95 % of their intervals on the truth; of all {} "
      "intervals {:.1f} % are.\n",
      set.structures.size() - 1, holding, whole.estimates,
      100 * static_cast<double>(whole.covered) /
          static_cast<double>(std::max<std::size_t>(1, whole.estimates)));
}

}  // namespace

std::string foreign_page(const IdentificationSet& set, const std::vector<SetRun>& runs) {
  const auto done =
      std::count_if(runs.begin(), runs.end(), [](const auto& run) { return run.done; });
  const auto cells = cells_of(runs);
  std::string text = fmt::format(
      "# Identification of machines of foreign structures\n\n"
      "`{}` with what no estimator assumes, one structure at a time: seed 1 on the nominal "
      "machine, "
      "the others on machines\ndrawn within +-{:.0f} %. {}, {} of {} runs are done. Written "
      "by `./towbench identify --structure all`.\n\n",
      set.rig.name, 100 * set.spread,
      set.axes.size() == 2 ? "Both axes" : fmt::format("Axis {}", core::name_of(set.axes.front())),
      done, runs.size());
  text += other_settings(set) + structures_table(set);
  text +=
      "\nA cell: intervals that hold the truth of those given, mean error and mean half width of "
      "the interval in % of the truth;\nbold where fewer than 95 % hold it; none: withheld or not "
      "found.\n";
  text += summary(set, cells);
  for (const auto& [title, columns] : kTables) {
    text += table_of(set, cells, title, columns);
  }
  text += "\n## Withheld\n\nWith the first reason.\n\n" + reasons(set, runs, &SetRun::withheld);
  text += "\n## Not done\n\n" + reasons(set, runs, &SetRun::not_done);
  return text;
}

}  // namespace towbench::study
