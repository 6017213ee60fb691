#include "study/diagnose/log_columns.h"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "study/statistics/statistics.h"

namespace towbench::study::diagnose {
namespace {

using Kind = logs::Finding::Kind;

constexpr std::size_t kFewestSamples = 400;
// Beside the middle 99 % of a column's values; no motion and no command does that.
constexpr double kAbsurd = 1e4;

class Finder {
 public:
  Finder(const logs::Table& table, const logs::ColumnMap& map, const std::string& file,
         logs::Findings& findings)
      : table_(table), map_(map), file_(file), findings_(findings) {}

  LogColumns find() {
    LogColumns c;
    c.time = needed(map_.time);
    c.position = needed(map_.position);
    c.input = needed(map_.input);
    c.reference = optional(map_.reference);
    if (!map_.temperature.empty()) c.temperature = needed(map_.temperature);
    for (const logs::OtherColumn& other : map_.others) c.others.push_back(needed(other.position));
    if (is_fatal(findings_)) {
      return c;
    }
    std::vector<const std::vector<double>*> used{c.time, c.position, c.input};
    if (c.temperature != nullptr) used.push_back(c.temperature);
    used.insert(used.end(), c.others.begin(), c.others.end());
    c.rows = usable_rows(used);
    drop_absurd(c.rows, *c.position, map_.position);
    drop_absurd(c.rows, *c.input, map_.input);
    if (c.temperature != nullptr) drop_absurd(c.rows, *c.temperature, map_.temperature);
    for (std::size_t i = 0; i < c.others.size(); ++i) {
      drop_absurd(c.rows, *c.others[i], map_.others[i].position);
    }
    if (c.rows.size() < kFewestSamples) {
      tell(Kind::kFatal, "too_short",
           fmt::format("{}: {} usable samples; at least {} are needed", file_, c.rows.size(),
                       kFewestSamples));
      return c;
    }
    refuse_constant(c.rows, *c.position, "constant_position", map_.position, "dead encoder");
    refuse_constant(c.rows, *c.input, "constant_input", map_.input, "dead channel");
    return c;
  }

 private:
  void tell(Kind kind, std::string name, std::string sentence) {
    findings_.push_back({kind, std::move(name), std::move(sentence)});
  }

  const std::vector<double>* optional(const std::string& name) {
    if (name.empty() || table_.find(name) == nullptr) {
      return nullptr;
    }
    if (table_.count(name) > 1) {
      tell(Kind::kFatal, "column_twice",
           fmt::format("{}: the header names '{}' {} times; which is it?", file_, name,
                       table_.count(name)));
    }
    return table_.find(name);
  }

  const std::vector<double>* needed(const std::string& name) {
    const auto* column = optional(name);
    if (column == nullptr) {
      tell(Kind::kFatal, "column_missing",
           fmt::format("{}: no column '{}'; its header has: {}", file_, name,
                       fmt::join(table_.names, " ")));
    } else if (std::none_of(column->begin(), column->end(),
                            [](double x) { return std::isfinite(x); })) {
      tell(Kind::kFatal, "not_a_number",
           fmt::format("{}:{}: '{}' is no number here, nor in any other row", file_,
                       table_.line.front(), name));
    }
    return column;
  }

  std::vector<std::size_t> usable_rows(const std::vector<const std::vector<double>*>& used) {
    if (table_.bad_rows > 0) {
      tell(Kind::kNote, "bad_rows",
           fmt::format("{}: {} rows left out, their cells are not as many as the header's", file_,
                       table_.bad_rows));
    }
    std::vector<std::size_t> rows;
    std::size_t first_refused = table_.rows();
    for (std::size_t i = 0; i < table_.rows(); ++i) {
      const bool finite = std::all_of(used.begin(), used.end(), [&](const auto* column) {
        return std::isfinite((*column)[i]);
      });
      if (finite) {
        rows.push_back(i);
      } else {
        first_refused = std::min(first_refused, i);
      }
    }
    if (first_refused < table_.rows()) {
      tell(Kind::kNote, "not_a_number",
           fmt::format("{}:{}: {} row{} left out from here on, time, position, input or another "
                       "column of the map is not a number there",
                       file_, table_.line[first_refused], table_.rows() - rows.size(),
                       table_.rows() - rows.size() == 1 ? "" : "s"));
    }
    return rows;
  }

  // One value of 1e300 would drown all others.
  void drop_absurd(std::vector<std::size_t>& rows, const std::vector<double>& column,
                   const std::string& name) {
    if (rows.empty()) {
      return;
    }
    std::vector<double> values;
    values.reserve(rows.size());
    for (const std::size_t row : rows) {
      values.push_back(column[row]);
    }
    const double low = statistics::quantile(values, 0.005);
    const double high = statistics::quantile(values, 0.995);
    const double reach = kAbsurd * (high - low);
    const auto absurd = [&](std::size_t row) {
      return reach > 0 && (column[row] < low - reach || column[row] > high + reach);
    };
    const auto first = std::find_if(rows.begin(), rows.end(), absurd);
    if (first == rows.end()) {
      return;
    }
    tell(Kind::kNote, "absurd_values",
         fmt::format("{}:{}: '{}' is {:.3g} here and elsewhere {:.3g} to {:.3g}; {} such row(s) "
                     "left out",
                     file_, table_.line[*first], name, column[*first], low, high,
                     std::count_if(rows.begin(), rows.end(), absurd)));
    std::erase_if(rows, absurd);
  }

  void refuse_constant(const std::vector<std::size_t>& rows, const std::vector<double>& column,
                       const char* finding, const std::string& name, const char* guess) {
    const bool constant = std::all_of(rows.begin(), rows.end(), [&](std::size_t row) {
      return column[row] == column[rows.front()];
    });
    if (constant) {
      tell(Kind::kFatal, finding,
           fmt::format("{}: '{}' is {:.6g} in every row: {} or wrong column", file_, name,
                       column[rows.front()], guess));
    }
  }

  const logs::Table& table_;
  const logs::ColumnMap& map_;
  const std::string& file_;
  logs::Findings& findings_;
};

}  // namespace

LogColumns find_columns(const logs::Table& table, const logs::ColumnMap& map,
                        const std::string& file, logs::Findings& findings) {
  return Finder(table, map, file, findings).find();
}

}  // namespace towbench::study::diagnose
