#include "bbmc/application/commands/command_table.h"
#include "bbmc/application/commands/machine_axes.h"
#include "bbmc/application/commands/parse.h"
#include "bbmc/application/reports/report.h"
#include "bbmc/system/system_manager.h"

namespace towbench::bbmc {
namespace {

constexpr std::size_t kMeaningColumn = 32;
constexpr std::size_t kOptionColumn = 22;

// "run -trapez [DOF]", "goto Y X".
void write_title(TextWriter& out, const CommandSpec& command,
                 const Configuration& configuration) noexcept {
  out.text(command.word);
  if (!command.sub.empty()) {
    out.text(command.is_default ? " [" : " ").text(command.sub);
    out.text(command.is_default ? "]" : "");
  }
  for (const OptionSpec& option : command.options) {
    if (option.is_positional() && applies(option, configuration)) {
      const bool required = option.presence == Presence::kRequired;
      out.text(required ? " " : " [").text(option.name).text(required ? "" : "]");
    }
  }
}

void write_option(TextWriter& out, const OptionSpec& option) noexcept {
  out.text("    ").text(option.name);
  if (!option.short_name.empty()) {
    out.text(", ").text(option.short_name);
  }
  out.column(kOptionColumn).text(option.meaning);
  if (option.kind != OptionKind::kFlag) {
    out.text(": ");
    write_allowed(out, option);
  }
  if (option.presence == Presence::kDefault && option.kind != OptionKind::kFlag) {
    out.text(", default ");
    if (option.default_text.empty()) {
      write_value(out, option, option.default_value);
    } else {
      out.text(option.default_text);
    }
  }
  if (option.kind == OptionKind::kQuantity && !option.bare_unit.empty() &&
      option.bare_unit != display_unit(option.dimension).name) {
    const bool gain = option.bare_unit == kBbmcGainUnit;
    out.text(gain ? ", bare number as in BBMC 0.5" : ", bare number in ");
    out.text(gain ? "" : option.bare_unit);
  }
  out.end_line();
}

}  // namespace

HelpReport::HelpReport(std::string_view word) noexcept : with_options_(!word.empty()) {
  for (const CommandSpec& command : command_table()) {
    if (command.word == word) {
      word_ = command.word;
    }
  }
}

bool HelpReport::next(const SystemManager& system, TextWriter& out) noexcept {
  const auto table = command_table();
  while (command_ < table.size() && !word_.empty() && table[command_].word != word_) {
    ++command_;
  }
  if (command_ > table.size()) {
    return false;
  }
  if (command_ == table.size()) {
    ++command_;
    if (!with_options_) {
      out.text("`help COMMAND` shows its options, `help all` those of every command.").end_line();
      return true;
    }
    out.text("Speeds are limited further by each axis (");
    std::string_view separator;
    for (const core::Axis axis : kAxes) {
      if (!system.configuration().axes[axis].exists) {
        continue;
      }
      out.text(separator).text(core::name_of(axis)).text(" ");
      separator = ", ";
      write_quantity(out, system.configuration().axes[axis].speed_limit_m_per_s, Dimension::kSpeed);
    }
    out.text(") and by the distance to its ends.").end_line();
    return true;
  }
  const CommandSpec& command = table[command_];
  if (option_ == 0) {
    out.text("  ");
    write_title(out, command, system.configuration());
    out.column(kMeaningColumn).text(command.meaning).end_line();
  } else {
    write_option(out, command.options[option_ - 1]);
  }
  do {
    ++option_;
  } while (option_ <= command.options.size() &&
           !applies(command.options[option_ - 1], system.configuration()));
  if (!with_options_ || option_ > command.options.size()) {
    option_ = 0;
    ++command_;
  }
  return true;
}

}  // namespace towbench::bbmc
