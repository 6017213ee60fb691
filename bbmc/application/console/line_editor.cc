#include "bbmc/application/console/line_editor.h"

#include <algorithm>

namespace towbench::bbmc {
namespace {

constexpr char kControlA = 0x01;
constexpr char kControlC = 0x03;
constexpr char kControlE = 0x05;
constexpr char kBackspace = 0x08;
constexpr char kTab = 0x09;
constexpr char kLineFeed = 0x0a;
constexpr char kReturn = 0x0d;
constexpr char kControlU = 0x15;
constexpr char kEscape = 0x1b;
constexpr char kDelete = 0x7f;
constexpr std::string_view kBell = "\a";

constexpr bool is_kept(char c) noexcept {
  return c >= ' ' && c <= '~';
}

}  // namespace

LineEditor::Event LineEditor::feed(char byte, TextWriter& screen) noexcept {
  if (finished_) {
    finished_ = false;
    size_ = 0;
    cursor_ = 0;
    damaged_ = false;
  }
  // CR, LF and CR LF all end one line.
  const bool second_of_pair = last_was_return_ && byte == kLineFeed;
  last_was_return_ = byte == kReturn;
  if (second_of_pair) {
    return Event::kNone;
  }
  if (escape_ != Escape::kNone) {
    feed_escape(byte, screen);
    return Event::kNone;
  }
  if (is_kept(byte)) {
    insert(byte, screen);
    return Event::kNone;
  }
  return feed_control(byte, screen);
}

LineEditor::Event LineEditor::feed_control(char byte, TextWriter& screen) noexcept {
  switch (byte) {
    case kReturn:
    case kLineFeed:
      return end_line(screen);
    case kControlC:
      replace({}, screen);
      return Event::kInterrupt;
    case kBackspace:
    case kDelete:
      if (cursor_ > 0) {
        erase_at(cursor_ - 1, screen);
      }
      return Event::kNone;
    case kTab:
      insert(' ', screen);
      return Event::kNone;
    case kControlA:
      cursor_ = 0;
      redraw(screen);
      return Event::kNone;
    case kControlE:
      cursor_ = size_;
      redraw(screen);
      return Event::kNone;
    case kControlU:
      replace({}, screen);
      return Event::kNone;
    case kEscape:
      escape_ = Escape::kStarted;
      escape_digit_ = 0;
      return Event::kNone;
    default:
      refuse(screen);
      return Event::kNone;
  }
}

// ESC [ A, ESC O A, ESC [ 3 ~: what terminals send for the keys of interest.
void LineEditor::feed_escape(char byte, TextWriter& screen) noexcept {
  if (escape_ == Escape::kStarted) {
    escape_ = byte == '[' || byte == 'O' ? Escape::kBracket : Escape::kNone;
    return;
  }
  if ((byte >= '0' && byte <= '9') || byte == ';') {
    escape_digit_ = byte;
    return;
  }
  escape_ = Escape::kNone;
  cursor_key(byte, screen);
}

void LineEditor::cursor_key(char final_byte, TextWriter& screen) noexcept {
  const bool is_delete = final_byte == '~' && escape_digit_ == '3';
  if (is_delete) {
    if (cursor_ < size_) {
      erase_at(cursor_, screen);
    }
    return;
  }
  switch (final_byte) {
    case 'A':
      replace(history_.older(), screen);
      return;
    case 'B':
      replace(history_.newer(), screen);
      return;
    case 'C':
      cursor_ = std::min(cursor_ + 1, size_);
      break;
    case 'D':
      cursor_ -= std::min<std::size_t>(cursor_, 1);
      break;
    case 'H':
      cursor_ = 0;
      break;
    case 'F':
      cursor_ = size_;
      break;
    default:
      return;
  }
  redraw(screen);
}

LineEditor::Event LineEditor::end_line(TextWriter& screen) noexcept {
  finished_ = true;
  if (echo_) {
    screen.end_line();
  }
  if (damaged_) {
    return Event::kDamagedLine;
  }
  history_.add(line());
  return Event::kLine;
}

void LineEditor::insert(char byte, TextWriter& screen) noexcept {
  if (size_ == line_.size()) {
    refuse(screen);
    return;
  }
  const auto at = line_.begin() + static_cast<std::ptrdiff_t>(cursor_);
  const auto end = line_.begin() + static_cast<std::ptrdiff_t>(size_);
  std::copy_backward(at, end, end + 1);
  *at = byte;
  ++size_;
  ++cursor_;
  if (!echo_) {
    return;
  }
  if (cursor_ == size_) {
    screen.text({&*at, 1});
  } else {
    redraw(screen);
  }
}

void LineEditor::erase_at(std::size_t position, TextWriter& screen) noexcept {
  const auto at = line_.begin() + static_cast<std::ptrdiff_t>(position);
  std::copy(at + 1, line_.begin() + static_cast<std::ptrdiff_t>(size_), at);
  --size_;
  cursor_ = position;
  redraw(screen);
}

void LineEditor::replace(std::string_view with, TextWriter& screen) noexcept {
  std::copy(with.begin(), with.end(), line_.begin());
  size_ = with.size();
  cursor_ = size_;
  damaged_ = false;
  redraw(screen);
}

void LineEditor::refuse(TextWriter& screen) noexcept {
  damaged_ = true;
  if (echo_) {
    screen.text(kBell);
  }
}

// The whole line again, then back to the cursor.
void LineEditor::redraw(TextWriter& screen) const noexcept {
  if (!echo_) {
    return;
  }
  screen.text("\r\x1b[K").text(prompt_).text(line());
  for (std::size_t i = cursor_; i < size_; ++i) {
    screen.text("\b");
  }
}

}  // namespace towbench::bbmc
