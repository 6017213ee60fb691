// -traject and -contrl: the values not given on the line are asked for one by one, as BBMC 0.5 did.
//
// An empty answer takes the default. A refused answer ends the command: nothing has changed.
#pragma once

#include <cstddef>
#include <string_view>

#include "bbmc/application/commands/option.h"
#include "bbmc/application/console/text_writer.h"
#include "bbmc/system/configuration.h"

namespace towbench::bbmc {

class Questionnaire {
 public:
  // Begins with what the line gave; pending() afterwards if a flag asks for more.
  void start(const CommandSpec& command, const Arguments& arguments) noexcept;

  [[nodiscard]] bool pending() const noexcept;
  [[nodiscard]] const CommandSpec& command() const noexcept { return *command_; }
  [[nodiscard]] const Arguments& arguments() const noexcept { return arguments_; }

  // What is asked and what is allowed, then (prompt) name and default in less than 64 characters.
  void write_question(TextWriter& out, TextWriter& prompt) const noexcept;

  // Takes the answer and goes to the next question.
  [[nodiscard]] core::ErrorCode answer(std::string_view text, const Configuration& configuration,
                                       TextWriter& why) noexcept;

 private:
  void skip_to_question() noexcept;

  const CommandSpec* command_ = nullptr;
  Arguments arguments_;
  bool asks_trajectory_ = false;
  bool asks_gains_ = false;
  std::size_t option_ = 0;
};

}  // namespace towbench::bbmc
