// help: from the same table that the parser reads.
#include <array>

#include "bbmc/application/commands/command_table.h"
#include "bbmc/application/commands/context.h"

namespace towbench::bbmc {
namespace {

using core::ErrorCode;

enum HelpOption : std::size_t { kTopic };
constexpr std::array<OptionSpec, 1> kHelpOptions{{
    {.name = "COMMAND",
     .kind = OptionKind::kChoice,
     .presence = Presence::kOptional,
     .choices =
         "all|run|path|goto|poscalib|rmpi|status|datalog|perf|reset|config|test|debug|help|quit",
     .meaning = "shows options, units, ranges and defaults"},
}};

std::string_view chosen(std::size_t index) noexcept {
  std::string_view rest = kHelpOptions[kTopic].choices;
  for (; index > 0; --index) {
    rest.remove_prefix(rest.find('|') + 1);
  }
  return rest.substr(0, rest.find('|'));
}

ErrorCode help(CommandContext& context, const Arguments& arguments) {
  context.report.start(
      HelpReport(arguments.given(kTopic) ? chosen(arguments.choice(kTopic)) : std::string_view()));
  return ErrorCode::kNone;
}

}  // namespace

const CommandSpec& help_command() noexcept {
  static constexpr CommandSpec kCommand{
      .word = "help", .options = kHelpOptions, .handler = help, .meaning = "lists the commands"};
  return kCommand;
}

}  // namespace towbench::bbmc
