// Replies of any length, produced a few lines at a time as the UART takes them: nothing is
// buffered whole, nothing blocks, nothing is lost.
#pragma once

#include <cstddef>
#include <string_view>
#include <variant>

#include "bbmc/application/console/text_writer.h"
#include "bbmc/device/axes.h"

namespace towbench::bbmc {

class SystemManager;

// The list of commands, one word's commands with their options, or all of that.
class HelpReport {
 public:
  HelpReport() noexcept = default;
  // `word` is a command's word, "all", or empty for the list.
  explicit HelpReport(std::string_view word) noexcept;
  [[nodiscard]] bool next(const SystemManager& system, TextWriter& out) noexcept;

 private:
  // Into the command table's own storage, which outlives every line typed.
  std::string_view word_;
  bool with_options_ = false;
  std::size_t command_ = 0;
  std::size_t option_ = 0;  // 0: the command's own line
};

class StatusReport {
 public:
  [[nodiscard]] bool next(const SystemManager& system, TextWriter& out) noexcept;

 private:
  std::size_t part_ = 0;
};

// DATALOG_BEGIN ... DATALOG_END of one axis or of both, rows as comma separated values.
class DataLogReport {
 public:
  DataLogReport() noexcept = default;
  explicit DataLogReport(PerAxis<bool> wanted) noexcept : wanted_(wanted) {}
  [[nodiscard]] bool next(SystemManager& system, TextWriter& out) noexcept;

 private:
  enum class Stage : unsigned char { kHeader, kRows };
  PerAxis<bool> wanted_{};
  std::size_t axis_ = 0;
  std::size_t row_ = 0;
  Stage stage_ = Stage::kHeader;
};

// Lateness and execution time of the control ticks, with their histograms.
class PerfLogReport {
 public:
  [[nodiscard]] bool next(SystemManager& system, TextWriter& out) noexcept;

 private:
  std::size_t part_ = 0;
};

// Every value of the configuration as it holds now, with its key of the controller file.
class ConfigReport {
 public:
  [[nodiscard]] bool next(const SystemManager& system, TextWriter& out) noexcept;

 private:
  std::size_t value_ = 0;
};

class Report {
 public:
  template <typename T>
  void start(const T& report) noexcept {
    content_ = report;
  }
  void stop() noexcept { content_ = std::monostate{}; }
  [[nodiscard]] bool active() const noexcept {
    return !std::holds_alternative<std::monostate>(content_);
  }
  // Writes the next part; false when there is none and the report is over.
  [[nodiscard]] bool next(SystemManager& system, TextWriter& out) noexcept;

 private:
  std::variant<std::monostate, HelpReport, StatusReport, DataLogReport, PerfLogReport, ConfigReport>
      content_;
};

}  // namespace towbench::bbmc
