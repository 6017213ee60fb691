#include "harness/lockstep/console_script.h"

#include <algorithm>
#include <utility>

#include <fmt/format.h>

namespace towbench::harness {
namespace {

// What stands after the terminal's own echo of the command. An echo that is still under way has no
// answer yet; a console that redraws its line, or does not echo, answers from its second line on.
std::string_view answer_in(const ConsoleStep& step, std::string_view heard) {
  if (step.send.empty()) {
    return heard;
  }
  if (const auto echo = heard.find(step.send); echo != std::string_view::npos) {
    return heard.substr(echo + step.send.size());
  }
  const auto end_of_line = heard.find_first_of("\r\n");
  return end_of_line == std::string_view::npos ? std::string_view{} : heard.substr(end_of_line + 1);
}

// The line that ends a refused command, "error 205: ...", when it is complete.
std::string_view refusal_in(std::string_view answer) {
  for (std::size_t start = 0; start < answer.size();) {
    const auto end = answer.find('\n', start);
    if (end == std::string_view::npos) {
      break;
    }
    const auto line = answer.substr(start, end - start);
    if (line.starts_with("error ")) {
      return line.substr(0, line.find('\r'));
    }
    start = end + 1;
  }
  return {};
}

std::string last_line_of(std::string_view text) {
  std::string last(text.substr(0, text.find_last_not_of("\r\n> ") + 1));
  return last.substr(last.find_last_of("\r\n") + 1);
}

}  // namespace

ConsoleScript::ConsoleScript(std::vector<ConsoleStep> steps) : steps_(std::move(steps)) {}

std::string_view ConsoleScript::pending(core::Nanoseconds /*now_ns*/) {
  return phase_ == Phase::kType ? std::string_view(to_type_) : std::string_view{};
}

void ConsoleScript::typed(std::size_t bytes) {
  to_type_.erase(0, bytes);
}

void ConsoleScript::hear(std::string_view text) {
  heard_ += text;
}

void ConsoleScript::begin_step(core::Nanoseconds now_ns) {
  const auto& step = steps_[current_];
  to_type_ = step.send.empty() ? std::string{} : step.send + "\r";
  heard_.clear();
  waiting_since_ns_ = now_ns;
}

void ConsoleScript::fail(std::string why) {
  failure_ = fmt::format("console step {} ({}): {}", current_ + 1,
                         steps_[current_].send.empty() ? "no text" : steps_[current_].send, why);
}

bool ConsoleScript::heard_expected() {
  const auto& step = steps_[current_];
  const auto answer = answer_in(step, heard_);
  if (step.expect.empty() || answer.find(step.expect) != std::string_view::npos) {
    return true;
  }
  // A refusal that nobody expected: what was hoped for will not come any more.
  if (const auto refusal = refusal_in(answer); !refusal.empty()) {
    fail(fmt::format("expected \"{}\", the console answered \"{}\"", step.expect, refusal));
  }
  return false;
}

bool ConsoleScript::advance_phase(core::Nanoseconds now_ns, bool idle) {
  const auto& step = steps_[current_];
  switch (phase_) {
    case Phase::kWaitForTime:
      if (now_ns < core::nanoseconds(step.at_s.value_or(0))) {
        return false;
      }
      begin_step(now_ns);
      return true;
    case Phase::kType:
      waiting_since_ns_ = now_ns;
      return to_type_.empty();
    case Phase::kExpect:
      return heard_expected();
    case Phase::kWaitForIdle:
      return !step.wait_idle || idle;
    case Phase::kPause:
      return now_ns - waiting_since_ns_ >= core::nanoseconds(step.wait_s);
  }
  return false;
}

ConsoleScript::Progress ConsoleScript::update(core::Nanoseconds now_ns, bool idle) {
  while (failure_.empty() && current_ < steps_.size() && advance_phase(now_ns, idle)) {
    if (phase_ != Phase::kPause) {
      phase_ = static_cast<Phase>(static_cast<int>(phase_) + 1);
      waiting_since_ns_ = phase_ == Phase::kPause ? now_ns : waiting_since_ns_;
      continue;
    }
    ++current_;
    phase_ = Phase::kWaitForTime;
  }
  const bool limited = phase_ == Phase::kExpect || phase_ == Phase::kWaitForIdle;
  if (failure_.empty() && current_ < steps_.size() && limited &&
      now_ns - waiting_since_ns_ >= core::nanoseconds(steps_[current_].timeout_s)) {
    fail(fmt::format(
        "{} did not come within {} s; the console's last line was \"{}\"",
        phase_ == Phase::kExpect ? fmt::format("\"{}\"", steps_[current_].expect) : "rest",
        steps_[current_].timeout_s, last_line_of(heard_)));
  }
  if (!failure_.empty()) {
    return Progress::kFailed;
  }
  return current_ == steps_.size() ? Progress::kDone : Progress::kRunning;
}

}  // namespace towbench::harness
