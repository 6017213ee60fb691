#include "bbmc/application/application.h"

#include <algorithm>
#include <span>

#include "bbmc/application/commands/command_table.h"
#include "bbmc/application/commands/parse.h"
#include "bbmc/application/console/tokens.h"
#include "bbmc/device/device_manager.h"
#include "bbmc/system/system_manager.h"

namespace towbench::bbmc {
namespace {

using core::ErrorCode;

constexpr std::string_view kPrompt = "bbmc> ";
constexpr char kInterrupt = 0x03;
// Steps of one poll: enough for every reply, and a bound whatever is typed.
constexpr int kStepsPerPoll = 4096;
constexpr std::size_t kWhySize = 256;
// Numbers below are refusals and results, from here on latched faults (core/error.h).
constexpr std::uint16_t kFirstFault = 300;

}  // namespace

void Application::poll(core::Nanoseconds /*now*/) noexcept {
  for (int i = 0; i < kStepsPerPoll; ++i) {
    fetch();
    if (!flush() || !step()) {
      return;
    }
  }
}

// True when the UART has taken everything.
bool Application::flush() noexcept {
  while (outbox_sent_ < outbox_.view().size()) {
    const std::string_view waiting = outbox_.view().substr(outbox_sent_);
    Uart::Chunk chunk;
    chunk.assign(std::span(waiting).first(std::min(waiting.size(), Uart::kChunk)));
    if (!devices_.console().write(chunk)) {
      return false;
    }
    outbox_sent_ += chunk.size();
  }
  outbox_.clear();
  outbox_sent_ = 0;
  return true;
}

// Takes what the UART has as long as there is room; what there is no room for stays in the UART.
void Application::fetch() noexcept {
  Uart::Chunk chunk;
  while (typed_.room() >= Uart::kChunk && devices_.console().read(chunk) && !chunk.empty()) {
    for (const char byte : chunk) {
      const bool busy = stage_ == Stage::kReporting || stage_ == Stage::kMoving;
      if (busy && byte == kInterrupt) {
        // Whoever interrupts does not want what was typed ahead either.
        interrupted_ = true;
        typed_.clear();
        continue;
      }
      core::check(typed_.push(byte));
    }
  }
}

bool Application::step() noexcept {
  switch (stage_) {
    case Stage::kStarting:
      start();
      return true;
    case Stage::kReading:
    case Stage::kAsking: {
      char byte = 0;
      if (!typed_.pop(byte)) {
        return false;
      }
      take(byte);
      return true;
    }
    case Stage::kReporting:
      report();
      return true;
    case Stage::kMoving:
      if (interrupted_) {
        interrupted_ = false;
        // Refused when the motion has just ended or already brakes: then there is nothing to stop.
        static_cast<void>(system_.stop());
      }
      if (!system_.at_rest()) {
        return false;
      }
      end_motion();
      return true;
  }
  return false;
}

void Application::start() noexcept {
  outbox_.text("BBMC. `help` lists the commands.").end_line().text(kPrompt);
  editor_.set_prompt(kPrompt);
  stage_ = Stage::kReading;
}

void Application::take(char byte) noexcept {
  editor_.set_echo(settings_.echo);
  switch (editor_.feed(byte, outbox_)) {
    case LineEditor::Event::kNone:
      return;
    case LineEditor::Event::kInterrupt:
      if (stage_ == Stage::kAsking) {
        outbox_.end_line();
        finish(ErrorCode::kRequestWrongState, "interrupted, nothing has changed");
      }
      return;
    case LineEditor::Event::kDamagedLine:
      finish(ErrorCode::kRequestBadArgument, "the line is too long or holds odd characters");
      return;
    case LineEditor::Event::kLine:
      take_line(editor_.line());
      return;
  }
}

void Application::take_line(std::string_view line) noexcept {
  if (stage_ == Stage::kAsking) {
    take_answer(line);
  } else {
    execute(line);
  }
}

void Application::execute(std::string_view line) noexcept {
  const core::Result<Tokens> words = split_line(line);
  if (!words) {
    finish(words.error(), "too many words");
    return;
  }
  if (words->empty()) {
    outbox_.text(kPrompt);
    return;
  }
  std::array<char, kWhySize> why_storage{};
  TextWriter why(why_storage);
  FoundCommand found;
  Arguments arguments;
  ErrorCode code = find_command(*words, found, why);
  if (code == ErrorCode::kNone) {
    code = parse_arguments(*found.spec, found.arguments, system_.configuration(), arguments, why);
  }
  if (code != ErrorCode::kNone) {
    finish(code, why.view());
    return;
  }
  questionnaire_.start(*found.spec, arguments);
  ask();
}

void Application::ask() noexcept {
  if (!questionnaire_.pending()) {
    editor_.set_prompt(kPrompt);
    perform(questionnaire_.command(), questionnaire_.arguments());
    return;
  }
  TextWriter prompt(question_storage_);
  questionnaire_.write_question(outbox_, prompt);
  outbox_.text(prompt.view());
  editor_.set_prompt(prompt.view());
  stage_ = Stage::kAsking;
}

void Application::take_answer(std::string_view line) noexcept {
  std::array<char, kWhySize> why_storage{};
  TextWriter why(why_storage);
  const ErrorCode code = questionnaire_.answer(line, system_.configuration(), why);
  if (code != ErrorCode::kNone) {
    finish(code, why.view());
    return;
  }
  ask();
}

void Application::perform(const CommandSpec& command, const Arguments& arguments) noexcept {
  std::array<char, kWhySize> why_storage{};
  TextWriter why(why_storage);
  CommandContext context{.system = system_,
                         .devices = devices_,
                         .settings = settings_,
                         .out = outbox_,
                         .why = why,
                         .report = report_};
  motions_before_ = system_.status().motions_ended;
  const ErrorCode code = command.handler(context, arguments);
  if (context.motion_started) {
    motion_code_ = code;
    epilogue_ = context.epilogue;
    epilogue_axis_ = context.epilogue_axis;
    interrupted_ = false;
    stage_ = Stage::kMoving;
    return;
  }
  if (code == ErrorCode::kNone && report_.active()) {
    interrupted_ = false;
    stage_ = Stage::kReporting;
    return;
  }
  report_.stop();
  finish(code, why.view());
}

void Application::report() noexcept {
  if (interrupted_) {
    interrupted_ = false;
    report_.stop();
    outbox_.end_line();
    finish(ErrorCode::kRequestWrongState, "interrupted");
    return;
  }
  if (!report_.next(system_, outbox_)) {
    finish(ErrorCode::kNone, {});
  }
}

void Application::write_debug() noexcept {
  const SystemStatus& status = system_.status();
  for (const core::Axis axis : kAxes) {
    if (!system_.configuration().axes[axis].exists) {
      continue;
    }
    const AxisStatus& state = status.axes[axis];
    outbox_.text("debug ").text(core::name_of(axis)).text(": reference ");
    outbox_.fixed(state.reference_m, 7).text("m, position ").fixed(state.position_m, 7);
    outbox_.text("m, integral ").fixed(1e3 * state.integral_Nm, 4).text("mNm, disturbance ");
    outbox_.fixed(1e3 * state.disturbance_Nm, 4).text("mNm").end_line();
  }
  outbox_.text("debug: ticks ").integer(static_cast<std::int64_t>(status.control_ticks));
  outbox_.text(", late ").integer(static_cast<std::int64_t>(status.late_ticks));
  outbox_.text(", rows lost ").integer(static_cast<std::int64_t>(system_.rows_lost())).end_line();
}

void Application::end_motion() noexcept {
  const SystemStatus& status = system_.status();
  if (settings_.debug) {
    write_debug();
  }
  // A fault before the motion could begin leaves no motion to have ended.
  const bool ended = status.motions_ended != motions_before_;
  const ErrorCode result = ended ? status.last_motion_result : status.fault;
  if (result != ErrorCode::kNone) {
    const bool is_fault = core::number_of(result) >= kFirstFault;
    outbox_.text(is_fault ? "stopped: fault " : "stopped: ");
    outbox_.integer(core::number_of(result)).text(" ");
    outbox_.text(core::describe(result)).end_line();
    finish(result, {});
    return;
  }
  if (status.stopped_by_user) {
    outbox_.text("stopped: on request").end_line();
  } else {
    if (epilogue_ != nullptr) {
      epilogue_(system_, epilogue_axis_, outbox_);
    }
    outbox_.text("done").end_line();
  }
  finish(motion_code_, {});
}

void Application::finish(ErrorCode code, std::string_view why) noexcept {
  if (code == ErrorCode::kNone) {
    outbox_.text("ok");
  } else {
    outbox_.text("error ").integer(core::number_of(code)).text(": ").text(core::describe(code));
    outbox_.text(why.empty() ? "" : ": ").text(why);
  }
  outbox_.end_line().text(kPrompt);
  editor_.set_prompt(kPrompt);
  stage_ = Stage::kReading;
}

}  // namespace towbench::bbmc
