// What a person types becomes a line: echo, cursor keys, deletion, history.
//
// Bytes go in one at a time; what the terminal must show comes out through a writer. A line that
// is too long or holds bytes no command is made of is reported as damaged and never executed.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <string_view>

#include "bbmc/application/console/history.h"
#include "bbmc/application/console/text_writer.h"
#include "bbmc/application/console/tokens.h"

namespace towbench::bbmc {

class LineEditor {
 public:
  enum class Event : std::uint8_t {
    kNone,
    kLine,         // line() holds it until the next feed()
    kDamagedLine,  // too long, or with bytes that do not belong into a command
    kInterrupt,    // Ctrl-C; the line typed so far is gone
  };

  static constexpr std::size_t kMaxPrompt = 64;
  // The most that one byte can make the terminal show.
  static constexpr std::size_t kMaxEcho = 2 * kMaxLineLength + kMaxPrompt + 8;

  // At most kMaxPrompt characters, in storage that outlives the line; the caller shows it first.
  void set_prompt(std::string_view prompt) noexcept { prompt_ = prompt; }

  // Off for scripts: nothing is written but by commands.
  void set_echo(bool on) noexcept { echo_ = on; }
  [[nodiscard]] bool echo() const noexcept { return echo_; }

  Event feed(char byte, TextWriter& screen) noexcept;
  [[nodiscard]] std::string_view line() const noexcept { return {line_.data(), size_}; }

 private:
  enum class Escape : std::uint8_t { kNone, kStarted, kBracket };

  Event feed_control(char byte, TextWriter& screen) noexcept;
  void feed_escape(char byte, TextWriter& screen) noexcept;
  void cursor_key(char final_byte, TextWriter& screen) noexcept;
  Event end_line(TextWriter& screen) noexcept;
  void insert(char byte, TextWriter& screen) noexcept;
  void erase_at(std::size_t position, TextWriter& screen) noexcept;
  void replace(std::string_view with, TextWriter& screen) noexcept;
  void refuse(TextWriter& screen) noexcept;
  void redraw(TextWriter& screen) const noexcept;

  std::string_view prompt_;
  std::array<char, kMaxLineLength> line_{};
  std::size_t size_ = 0;
  std::size_t cursor_ = 0;
  History history_;
  Escape escape_ = Escape::kNone;
  char escape_digit_ = 0;
  bool echo_ = true;
  bool damaged_ = false;
  bool finished_ = false;
  bool last_was_return_ = false;
};

}  // namespace towbench::bbmc
