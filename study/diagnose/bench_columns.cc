#include "study/diagnose/bench_columns.h"

#include <fmt/format.h>

namespace towbench::study::diagnose {

logs::ColumnMap bench_columns(const logs::Table& table, const NominalModel& model,
                              const std::string& file, logs::Findings& findings) {
  logs::ColumnMap map;
  const std::string axis = model.axis + "_";
  if (table.find(axis + "count") != nullptr && model.metres_per_count > 0) {
    map.position = axis + "count";
    map.position_scale_m = model.metres_per_count;
    map.position_is_count = true;
  } else {
    map.position = axis + "position_m";
  }
  if (table.find(axis + "duty_pct") != nullptr && model.newton_per_duty_pct > 0) {
    map.input = axis + "duty_pct";
    map.input_scale_N = model.newton_per_duty_pct;
  } else {
    map.input = axis + "force_N";
  }
  if (table.find(axis + "reference_m") != nullptr) {
    map.reference = axis + "reference_m";
  }
  const std::string other = (model.axis == "y" ? "x" : "y") + std::string("_position_m");
  if (table.find(other) != nullptr) {
    map.others.push_back({.position = other});
  }
  for (const auto* name : {&map.time, &map.position, &map.input}) {
    if (table.find(*name) == nullptr) {
      findings.push_back(
          {logs::Finding::Kind::kFatal, "columns_unusable",
           fmt::format("{}: no column '{}' as in a log of the bench, its header has: {}; "
                       "name the columns with --columns MAP.toml",
                       file, *name, fmt::join(table.names, " "))});
      break;
    }
  }
  return map;
}

void use_model_units(logs::ColumnMap& map, const NominalModel& model, const std::string& file,
                     logs::Findings& findings) {
  const auto refuse = [&](const char* what, const char* instead) {
    findings.push_back(
        {logs::Finding::Kind::kFatal, "columns_unusable",
         fmt::format("{}: {}, which no plant file states here; {}", file, what, instead)});
  };
  if (!map.count.empty()) {
    if (model.metres_per_count <= 0) {
      return refuse("'count' needs metres a count",
                    "name it 'position' with position_scale_m and position_is_count = true");
    }
    map.position = map.count;
    map.position_scale_m = model.metres_per_count;
    map.position_is_count = true;
  }
  if (!map.duty.empty()) {
    if (model.newton_per_duty_pct <= 0) {
      return refuse("'duty' needs newtons a per cent", "name it 'input' with input_scale_N");
    }
    map.input = map.duty;
    map.input_scale_N = map.duty_scale_pct * model.newton_per_duty_pct;
  }
}

}  // namespace towbench::study::diagnose
