#include "study/logs/csv_table.h"

#include <algorithm>

#include <fmt/format.h>

#include "harness/files/csv_row.h"
#include "study/logs/bounded_lines.h"

namespace towbench::study::logs {
namespace {

constexpr std::string_view kByteOrderMark = "\xEF\xBB\xBF";
constexpr std::string_view kPadding = " \t\r\"";

char separator_of(std::string_view header) {
  const auto count = [&](char sign) { return std::count(header.begin(), header.end(), sign); };
  char most = ',';
  for (const char sign : {';', '\t'}) {
    most = count(sign) > count(most) ? sign : most;
  }
  return most;
}

class Reader {
 public:
  Reader(const std::filesystem::path& path, Findings& findings, LineSpan span)
      : file_(path.string()), lines_(path), findings_(findings), span_(span) {}

  Table read() {
    if (read_header()) {
      read_rows();
    }
    return std::move(table_);
  }

 private:
  void refuse(std::string name, const std::string& sentence) {
    findings_.push_back({Finding::Kind::kFatal, std::move(name), sentence});
  }

  bool next(std::string_view& line) {
    while (lines_.number() + 1 < span_.first && lines_.next(line)) {
    }
    return lines_.number() < span_.last && lines_.next(line);
  }

  bool read_header() {
    std::string_view line;
    bool found = false;
    while (!found && next(line)) {
      line.remove_prefix(line.starts_with(kByteOrderMark) ? kByteOrderMark.size() : 0);
      found = !line.empty() && line.front() != '#';
    }
    if (!found && !lines_.line_too_long()) {
      refuse("file_unreadable", file_ + ": cannot be opened, or is empty");
      return false;
    }
    if (lines_.line_too_long() || line.find('\0') != std::string_view::npos ||
        line.find('\r') != std::string_view::npos) {
      refuse("header_unusable",
             fmt::format("{}:{}: no text in lines that end in a line feed; a log is CSV, UTF-8",
                         file_, lines_.number()));
      return false;
    }
    separator_ = separator_of(line);
    split(line);
    for (const auto cell : cells_) {
      table_.names.emplace_back(cell);
    }
    return header_is_usable();
  }

  bool header_is_usable() {
    const std::size_t count = table_.names.size();
    const std::string where = fmt::format("{}:{}", file_, lines_.number());
    if (count < 2 || count > kMostColumns) {
      refuse("header_unusable",
             fmt::format("{}: the header has {} column{}; a log names time, position and input, "
                         "{} at most, parted by commas, semicolons or tabs",
                         where, count, count == 1 ? "" : "s", kMostColumns));
      return false;
    }
    if (std::all_of(cells_.begin(), cells_.end(),
                    [](std::string_view cell) { return harness::csv_number(cell).has_value(); })) {
      refuse("header_unusable", where + ": numbers where the columns should be named");
      return false;
    }
    table_.columns.resize(count);
    return true;
  }

  void read_rows() {
    std::string_view line;
    while (next(line)) {
      if (!line.empty() && line.front() != '#') {
        add_row(line);
      }
      if (table_.rows() > kMostRows) {
        refuse("too_long", fmt::format("{}: more than {} rows; cut it into runs of some minutes",
                                       file_, kMostRows));
        return;
      }
    }
    if (lines_.line_too_long()) {
      refuse("rows_unlike_header", fmt::format("{}:{}: a line of more than {} bytes", file_,
                                               lines_.number(), kLongestLine));
    } else if (table_.bad_rows > table_.rows()) {
      refuse("rows_unlike_header",
             fmt::format("{}:{}: {} cells, and the header names {} columns; so in {} more rows{}",
                         file_, table_.first_bad_line, table_.first_bad_cells, table_.names.size(),
                         table_.bad_rows - 1,
                         separator_ == ',' && table_.first_bad_cells > table_.names.size()
                             ? "; decimal commas between commas?"
                             : ""));
    } else if (table_.rows() == 0) {
      refuse("no_rows", file_ + ": a header, and nothing below it");
    }
  }

  void split(std::string_view line) { harness::split_csv_row(line, separator_, kPadding, cells_); }

  void add_row(std::string_view line) {
    if (separator_ != ',' && line.find(',') != std::string_view::npos) {
      pointed_.assign(line);
      std::replace(pointed_.begin(), pointed_.end(), ',', '.');
      line = pointed_;
    }
    split(line);
    if (cells_.size() == table_.names.size() + 1 && cells_.back().empty()) {
      cells_.pop_back();
    }
    if (cells_.size() != table_.names.size()) {
      if (table_.bad_rows == 0) {
        table_.first_bad_line = lines_.number();
        table_.first_bad_cells = cells_.size();
      }
      ++table_.bad_rows;
      return;
    }
    for (std::size_t i = 0; i < cells_.size(); ++i) {
      table_.columns[i].push_back(harness::csv_number(cells_[i]).value_or(harness::kNoNumber));
    }
    table_.line.push_back(static_cast<std::uint32_t>(lines_.number()));
  }

  std::string file_;
  BoundedLines lines_;
  Findings& findings_;
  LineSpan span_;
  Table table_;
  char separator_ = ',';
  std::vector<std::string_view> cells_;
  std::string pointed_;
};

}  // namespace

Table read_csv_table(const std::filesystem::path& path, Findings& findings, LineSpan span) {
  return Reader(path, findings, span).read();
}

}  // namespace towbench::study::logs
