// From words to a command and its arguments.
#pragma once

#include <cstddef>
#include <string_view>

#include "bbmc/application/commands/option.h"
#include "bbmc/application/console/text_writer.h"
#include "bbmc/application/console/tokens.h"
#include "bbmc/system/configuration.h"
#include "core/error.h"

namespace towbench::bbmc {

struct FoundCommand {
  const CommandSpec* spec = nullptr;
  Tokens arguments;  // without the words that name the command
};

// Nothing found: `why` says what there is instead, and the code is kRequestUnknown or
// kRequestMissingArgument.
[[nodiscard]] core::ErrorCode find_command(const Tokens& words, FoundCommand& found,
                                           TextWriter& why) noexcept;

// All or nothing: `arguments` is complete when kNone is returned; otherwise `why` names the
// argument, what was given and what is allowed.
[[nodiscard]] core::ErrorCode parse_arguments(const CommandSpec& command, const Tokens& words,
                                              const Configuration& configuration,
                                              Arguments& arguments, TextWriter& why) noexcept;

// One option's value from its text, with the axis taken from what `arguments` already holds.
[[nodiscard]] core::ErrorCode parse_option(const CommandSpec& command, std::size_t option,
                                           std::string_view text,
                                           const Configuration& configuration, Arguments& arguments,
                                           TextWriter& why) noexcept;

// "0.001m/s .. 0.7m/s", "1 .. 1000", "y|x", "on|off".
void write_allowed(TextWriter& writer, const OptionSpec& option) noexcept;

// The value as help prints it.
void write_value(TextWriter& writer, const OptionSpec& option, double value) noexcept;

}  // namespace towbench::bbmc
