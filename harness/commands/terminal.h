// Standard input for an interactive console: raw on a terminal, as it comes from a pipe.
#pragma once

#include <optional>
#include <string>

#include <termios.h>

namespace towbench::harness {

class Terminal {
 public:
  // On a terminal every key is passed on at once, Ctrl-C too (it is for the machine, not for this
  // program).
  Terminal();
  Terminal(const Terminal&) = delete;
  Terminal& operator=(const Terminal&) = delete;
  // The terminal is as it was before.
  ~Terminal();

  [[nodiscard]] bool is_terminal() const noexcept { return saved_.has_value(); }
  // What has been typed since; never waits.
  [[nodiscard]] std::string read();
  // Nothing more will come.
  [[nodiscard]] bool at_end() const noexcept { return at_end_; }

 private:
  std::optional<termios> saved_;
  bool at_end_ = false;
};

}  // namespace towbench::harness
