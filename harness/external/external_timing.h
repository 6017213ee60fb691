// The loop of the plant in a run of an external controller by the wall clock, and how punctual both
// sides were.
#pragma once

#include <filesystem>
#include <memory>
#include <string>

#include "harness/external/answer_watch.h"
#include "harness/judge/judge.h"
#include "harness/realtime/run_timing.h"

namespace towbench::harness {

class ExternalTiming {
 public:
  // Takes real-time rights for the thread that makes it: after the controller's process has been
  // started, which must not have them.
  explicit ExternalTiming(core::Nanoseconds exchange_ns)
      : answers_(std::make_unique<AnswerWatch>(exchange_ns)) {}

  [[nodiscard]] TickLoop& loop() noexcept { return plant_.loop(); }
  [[nodiscard]] AnswerWatch& answers() noexcept { return *answers_; }
  // Adds the checks, writes realtime.json, and returns the figures in words.
  [[nodiscard]] std::string judge_into(const std::filesystem::path& folder,
                                       Judgement& judgement) const;

 private:
  EmulatorTiming plant_{{}};
  std::unique_ptr<AnswerWatch> answers_;
};

}  // namespace towbench::harness
