#include "bbmc/application/commands/command_table.h"

#include <array>

namespace towbench::bbmc {
namespace {

constexpr std::size_t kMaxCommands = 48;

struct Table {
  std::array<CommandSpec, kMaxCommands> commands;
  std::size_t size = 0;

  void add(const CommandSpec& command) noexcept {
    core::check(size < kMaxCommands);
    commands[size++] = command;
  }
  void add(std::span<const CommandSpec> group) noexcept {
    for (const CommandSpec& command : group) {
      add(command);
    }
  }
};

Table make_table() noexcept {
  Table table;
  table.add(run_trapezoid_command());
  table.add(run_circle_command());
  table.add(run_ellipse_command());
  table.add(run_sinusoid_command());
  table.add(run_spatial_command());
  table.add(path_commands());
  table.add(goto_command());
  table.add(goto_home_command());
  table.add(poscalib_command());
  table.add(rmpi_commands());
  table.add(status_command());
  table.add(data_log_commands());
  table.add(perf_log_commands());
  table.add(reset_commands());
  table.add(config_commands());
  table.add(test_commands());
  table.add(debug_commands());
  table.add(help_command());
  table.add(quit_command());
  return table;
}

}  // namespace

std::span<const CommandSpec> command_table() noexcept {
  static const Table table = make_table();
  return {table.commands.data(), table.size};
}

}  // namespace towbench::bbmc
