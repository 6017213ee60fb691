// BBMC's application layer: services and facilities behind a command line over a byte stream.
//
// Bytes come from and go to the console's UART through the device manager; nothing here knows
// files, threads or the host. poll() never blocks: what the UART does not take stays and
// goes out with a later poll, and no further command is read before it has gone.
//
// Every command ends with exactly one line, `ok` or `error NNN: why`, before the next prompt. A
// motion holds the prompt back until it has ended, with `done` or `stopped: ...` one line before;
// Ctrl-C asks it to stop.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <string_view>

#include "bbmc/application/commands/context.h"
#include "bbmc/application/commands/questionnaire.h"
#include "bbmc/application/console/byte_queue.h"
#include "bbmc/application/console/line_editor.h"
#include "bbmc/application/reports/report.h"
#include "core/error.h"
#include "core/time.h"

namespace towbench::bbmc {

class DeviceManager;
class SystemManager;

class Application {
 public:
  // Both outlive the application. The console's UART is opened and initialised by whoever owns the
  // devices; until then the console is silent.
  Application(SystemManager& system, DeviceManager& devices) noexcept
      : system_(system), devices_(devices) {}
  Application(const Application&) = delete;
  Application& operator=(const Application&) = delete;
  ~Application() = default;

  // Serves the console as of `now`. Not real-time: it runs beside the control path, never in it.
  void poll(core::Nanoseconds now) noexcept;

  // Until something is typed there is nothing to do: no motion runs that a command began, nothing
  // read from the UART is unserved, nothing waits for the UART to take it.
  [[nodiscard]] bool idle() const noexcept {
    return (stage_ == Stage::kReading || stage_ == Stage::kAsking) && typed_.empty() &&
           outbox_sent_ == outbox_.view().size();
  }
  // True after `quit`.
  [[nodiscard]] bool quit_requested() const noexcept { return settings_.quit; }

 private:
  enum class Stage : std::uint8_t {
    kStarting,
    kReading,    // a line
    kAsking,     // for a value that -traject or -contrl wants
    kReporting,  // a long reply
    kMoving,     // until the motion has ended
  };

  // What one step may write: an echo, a command's reply, or a part of a report.
  static constexpr std::size_t kOutboxSize = 2048;
  static constexpr std::size_t kTypeAhead = 1024;

  [[nodiscard]] bool flush() noexcept;
  void fetch() noexcept;
  // False when there is nothing to do before the next poll.
  [[nodiscard]] bool step() noexcept;
  void start() noexcept;
  void take(char byte) noexcept;
  void take_line(std::string_view line) noexcept;
  void take_answer(std::string_view line) noexcept;
  void execute(std::string_view line) noexcept;
  void perform(const CommandSpec& command, const Arguments& arguments) noexcept;
  void ask() noexcept;
  void report() noexcept;
  void end_motion() noexcept;
  void write_debug() noexcept;
  void finish(core::ErrorCode code, std::string_view why) noexcept;

  SystemManager& system_;
  DeviceManager& devices_;
  ConsoleSettings settings_;
  LineEditor editor_;
  Questionnaire questionnaire_;
  Report report_;
  Stage stage_ = Stage::kStarting;

  ByteQueue<kTypeAhead> typed_;
  bool interrupted_ = false;  // Ctrl-C during a report or a motion

  std::uint32_t motions_before_ = 0;
  core::ErrorCode motion_code_ = core::ErrorCode::kNone;
  MotionEpilogue epilogue_ = nullptr;
  core::Axis epilogue_axis_ = core::Axis::kY;

  std::array<char, kOutboxSize> outbox_storage_{};
  TextWriter outbox_{outbox_storage_};
  std::size_t outbox_sent_ = 0;
  std::array<char, LineEditor::kMaxPrompt> question_storage_{};
};

}  // namespace towbench::bbmc
