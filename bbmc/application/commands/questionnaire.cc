#include "bbmc/application/commands/questionnaire.h"

#include "bbmc/application/commands/parse.h"

namespace towbench::bbmc {
namespace {

bool flag_given(const CommandSpec& command, const Arguments& arguments, std::string_view name) {
  for (std::size_t i = 0; i < command.options.size(); ++i) {
    if (command.options[i].name == name) {
      return arguments.given(i);
    }
  }
  return false;
}

std::string_view without_blanks(std::string_view text) noexcept {
  while (!text.empty() && text.front() == ' ') {
    text.remove_prefix(1);
  }
  while (!text.empty() && text.back() == ' ') {
    text.remove_suffix(1);
  }
  return text;
}

}  // namespace

void Questionnaire::start(const CommandSpec& command, const Arguments& arguments) noexcept {
  command_ = &command;
  arguments_ = arguments;
  asks_trajectory_ = flag_given(command, arguments, "-traject");
  asks_gains_ = flag_given(command, arguments, "-contrl");
  option_ = 0;
  skip_to_question();
}

bool Questionnaire::pending() const noexcept {
  return command_ != nullptr && option_ < command_->options.size();
}

void Questionnaire::skip_to_question() noexcept {
  for (; pending(); ++option_) {
    const AskedBy asked_by = command_->options[option_].asked_by;
    const bool wanted = (asked_by == AskedBy::kTraject && asks_trajectory_) ||
                        (asked_by == AskedBy::kContrl && asks_gains_);
    if (wanted && !arguments_.given(option_)) {
      return;
    }
  }
}

void Questionnaire::write_question(TextWriter& out, TextWriter& prompt) const noexcept {
  const OptionSpec& option = command_->options[option_];
  out.text("  ").text(option.meaning).text(": ");
  write_allowed(out, option);
  out.end_line();
  prompt.text("  ").text(option.name).text(" [");
  if (option.presence == Presence::kDefault) {
    write_value(prompt, option, option.default_value);
  } else {
    prompt.text("as it is");
  }
  prompt.text("]: ");
}

core::ErrorCode Questionnaire::answer(std::string_view text, const Configuration& configuration,
                                      TextWriter& why) noexcept {
  const std::string_view value = without_blanks(text);
  if (!value.empty()) {
    const core::ErrorCode code =
        parse_option(*command_, option_, value, configuration, arguments_, why);
    if (code != core::ErrorCode::kNone) {
      return code;
    }
  }
  ++option_;
  skip_to_question();
  return core::ErrorCode::kNone;
}

}  // namespace towbench::bbmc
