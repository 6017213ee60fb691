// Feeds a controller's console with what a person or a pipe types. A pipe's lines are fed one at a
// time, each when the one before has been served, so that a file of commands runs as it would by
// hand.
#pragma once

#include <string>
#include <string_view>

#include "harness/commands/terminal.h"

namespace towbench::harness {

class Typist {
 public:
  // A ControllerNode, a LinuxNode: whatever has a console and says when it is idle.
  template <typename Controller>
  void feed(Controller& controller) {
    constexpr char kEndOfTransmission = 4;  // Ctrl-D on a terminal ends the session
    buffer_ += terminal_.read();
    if (terminal_.is_terminal()) {
      const auto end = buffer_.find(kEndOfTransmission);
      ended_ = ended_ || end != std::string::npos;
      buffer_.erase(0, controller.type(std::string_view(buffer_).substr(0, end)));
      return;
    }
    if (line_.empty() && controller.idle()) {
      const auto end = buffer_.find('\n');
      if (end != std::string::npos) {
        line_ = buffer_.substr(0, end) + "\r";
        buffer_.erase(0, end + 1);
      }
    }
    line_.erase(0, controller.type(line_));
    ended_ = terminal_.at_end() && line_.empty() && buffer_.find('\n') == std::string::npos;
  }
  [[nodiscard]] bool ended() const noexcept { return ended_; }

 private:
  Terminal terminal_;
  std::string buffer_;
  std::string line_;
  bool ended_ = false;
};

}  // namespace towbench::harness
