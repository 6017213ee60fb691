// Plays the experiment's conversation with the controller's console, in virtual time.
//
// Knows bytes and times only: whoever runs it types what pending() holds, tells what the console
// printed, and asks how it stands.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "core/time.h"
#include "harness/experiment/experiment.h"

namespace towbench::harness {

class ConsoleScript {
 public:
  enum class Progress : std::uint8_t { kRunning, kDone, kFailed };

  explicit ConsoleScript(std::vector<ConsoleStep> steps);

  // What is to be typed at `now_ns`; empty when nothing is.
  [[nodiscard]] std::string_view pending(core::Nanoseconds now_ns);
  // So many bytes of it were taken.
  void typed(std::size_t bytes);
  // What the console printed.
  void hear(std::string_view text);
  // Goes as far as it can. `idle`: no motion runs and nothing typed is unserved.
  Progress update(core::Nanoseconds now_ns, bool idle);

  // One sentence naming the step, what was expected and what was answered; empty unless kFailed.
  [[nodiscard]] const std::string& failure() const noexcept { return failure_; }
  [[nodiscard]] std::size_t steps_done() const noexcept { return current_; }
  [[nodiscard]] std::size_t steps() const noexcept { return steps_.size(); }

 private:
  enum class Phase : std::uint8_t { kWaitForTime, kType, kExpect, kWaitForIdle, kPause };

  // True when the phase is over.
  [[nodiscard]] bool advance_phase(core::Nanoseconds now_ns, bool idle);
  [[nodiscard]] bool heard_expected();
  void begin_step(core::Nanoseconds now_ns);
  void fail(std::string why);

  std::vector<ConsoleStep> steps_;
  std::size_t current_ = 0;
  Phase phase_ = Phase::kWaitForTime;
  std::string to_type_;
  std::string heard_;  // since the step's text was typed
  core::Nanoseconds waiting_since_ns_ = 0;
  std::string failure_;
};

}  // namespace towbench::harness
