#include "study/logs/column_map.h"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>
#include <toml++/toml.h>

#include "harness/files/regular_file.h"
#include "harness/files/toml_nesting.h"

namespace towbench::study::logs {
namespace {

void fatal(Findings& findings, std::string sentence) {
  findings.push_back({Finding::Kind::kFatal, "columns_unusable", std::move(sentence)});
}

bool assign(const toml::node& node, std::string& field) {
  const auto text = node.value_exact<std::string>();
  field = text.value_or("");
  return text.has_value();
}

bool assign(const toml::node& node, double& field) {
  const auto given = node.value<double>();
  field = given.value_or(0.0);
  return given.has_value() && std::isfinite(field) && field != 0.0;
}

bool assign(const toml::node& node, std::optional<bool>& field) {
  field = node.value_exact<bool>();
  return field.has_value();
}

bool assign(const toml::node& node, bool& field) {
  const auto given = node.value_exact<bool>();
  field = given.value_or(false);
  return given.has_value();
}

constexpr std::size_t kMostOthers = 5;

bool assign(const toml::table& table, OtherColumn& other) {
  for (const auto& [key, node] : table) {
    const bool taken = (key == "position" && assign(node, other.position)) ||
                       (key == "position_scale_m" && assign(node, other.position_scale_m)) ||
                       (key == "rotary" && assign(node, other.rotary));
    if (!taken) return false;
  }
  return !other.position.empty();
}

bool assign(const toml::node& node, std::vector<OtherColumn>& others) {
  const toml::array* tables = node.as_array();
  if (tables == nullptr || tables->empty() || tables->size() > kMostOthers) return false;
  return std::all_of(tables->begin(), tables->end(), [&](const toml::node& table) {
    return table.is_table() && assign(*table.as_table(), others.emplace_back());
  });
}

constexpr std::int64_t kSchema = 1;

// False when the key is unknown or its value is of the wrong kind.
bool set(ColumnMap& map, std::string_view key, const toml::node& node) {
  if (key == "schema") return node.value_exact<std::int64_t>() == kSchema;
  if (key == "time") return assign(node, map.time);
  if (key == "position") return assign(node, map.position);
  if (key == "count") return assign(node, map.count);
  if (key == "input") return assign(node, map.input);
  if (key == "duty") return assign(node, map.duty);
  if (key == "current") return assign(node, map.current);
  if (key == "reference") return assign(node, map.reference);
  if (key == "temperature") return assign(node, map.temperature);
  if (key == "other") return assign(node, map.others);
  if (key == "time_scale_s") return assign(node, map.time_scale_s);
  if (key == "position_scale_m") return assign(node, map.position_scale_m);
  if (key == "input_scale_N") return assign(node, map.input_scale_N);
  if (key == "duty_scale_pct") return assign(node, map.duty_scale_pct);
  if (key == "position_is_count") return assign(node, map.position_is_count);
  if (key == "input_hold") return assign(node, map.input_hold);
  if (key == "rotary") return assign(node, map.rotary);
  return false;
}

}  // namespace

ColumnMap read_column_map(const std::filesystem::path& path, Findings& findings) {
  ColumnMap map;
  try {
    constexpr std::uint64_t kLargestMap_bytes = 1U << 20U;
    const auto text = harness::read_regular_file(path, kLargestMap_bytes);
    if (const auto* refused = std::get_if<harness::Unreadable>(&text)) {
      fatal(findings, fmt::format("{}: {}, no column map", path.string(), refused->what));
      return map;
    }
    if (const auto line = harness::line_nested_too_deep(std::get<std::string>(text)); line != 0) {
      fatal(findings, fmt::format("{}:{}: keys nested too deep", path.string(), line));
      return map;
    }
    const toml::table table = toml::parse(std::get<std::string>(text), path.string());
    for (const auto& [key, node] : table) {
      if (!set(map, key.str(), node)) {
        fatal(findings,
              fmt::format("{}:{}: '{}' is no key of a column map, or its value is of the "
                          "wrong kind; known: schema time position count input duty "
                          "current reference temperature, *_scale_*, "
                          "position_is_count, input_hold, rotary, and [[other]] with "
                          "position, position_scale_m and rotary, at most {}",
                          path.string(), node.source().begin.line, key.str(), kMostOthers));
      }
    }
  } catch (const toml::parse_error& error) {
    fatal(findings,
          fmt::format("{}:{}: {}", path.string(), error.source().begin.line, error.description()));
  }
  if (map.position.empty() == map.count.empty() || map.input.empty() == map.duty.empty()) {
    fatal(findings, fmt::format("{}: a column map names one of position and count, and one of "
                                "input and duty",
                                path.string()));
  }
  return map;
}

}  // namespace towbench::study::logs
