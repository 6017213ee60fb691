// Where a session's operator is: at this terminal, or at the far end of a serial line.
#pragma once

#include <cstdio>
#include <string_view>

#include "bbmc/host/controller_node.h"
#include "harness/commands/typist.h"

namespace towbench::harness {

class SessionConsole {
 public:
  SessionConsole() = default;
  SessionConsole(const SessionConsole&) = delete;
  SessionConsole& operator=(const SessionConsole&) = delete;
  virtual ~SessionConsole() = default;

  // Types what the operator has typed. Never waits.
  virtual void feed(bbmc::ControllerNode& controller) = 0;
  // Shows what the controller printed.
  virtual void print(std::string_view text) = 0;
  // The operator has left: Ctrl-D, or the end of a pipe.
  [[nodiscard]] virtual bool ended() const = 0;
};

class OwnTerminal final : public SessionConsole {
 public:
  void feed(bbmc::ControllerNode& controller) override { typist_.feed(controller); }
  void print(std::string_view text) override {
    std::fwrite(text.data(), 1, text.size(), stdout);
    std::fflush(stdout);
  }
  [[nodiscard]] bool ended() const override { return typist_.ended(); }

 private:
  Typist typist_;
};

}  // namespace towbench::harness
