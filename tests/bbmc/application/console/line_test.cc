#include <array>
#include <string>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "bbmc/application/console/line_editor.h"
#include "bbmc/application/console/tokens.h"
#include "core/random.h"

namespace towbench::bbmc {
namespace {

using ::testing::ElementsAre;
using Event = LineEditor::Event;

// What a terminal of one line would show after the bytes: CR, backspace, erase to the end, text.
class Terminal {
 public:
  void show(std::string_view bytes) {
    for (std::size_t i = 0; i < bytes.size(); ++i) {
      const char c = bytes[i];
      if (c == '\r') {
        cursor_ = 0;
      } else if (c == '\b') {
        cursor_ -= cursor_ > 0 ? 1 : 0;
      } else if (bytes.substr(i).starts_with("\x1b[K")) {
        line_.resize(cursor_);
        i += 2;
      } else if (c == '\n') {
        line_.clear();
        cursor_ = 0;
      } else if (c != '\a') {
        line_.resize(std::max(line_.size(), cursor_ + 1), ' ');
        line_[cursor_++] = c;
      }
    }
  }
  [[nodiscard]] const std::string& line() const { return line_; }
  [[nodiscard]] std::size_t cursor() const { return cursor_; }

 private:
  std::string line_;
  std::size_t cursor_ = 0;
};

class Typist {
 public:
  Typist() {
    editor.set_prompt("> ");
    terminal.show("> ");
  }

  // Every line finished by the bytes; "!" in front of a damaged one, "^C" for an interrupt.
  std::vector<std::string> type(std::string_view bytes) {
    std::vector<std::string> lines;
    for (const char byte : bytes) {
      std::array<char, LineEditor::kMaxEcho> storage{};
      TextWriter screen(storage);
      const Event event = editor.feed(byte, screen);
      EXPECT_FALSE(screen.truncated());
      terminal.show(screen.view());
      shown += screen.view();
      if (event == Event::kLine) {
        lines.emplace_back(editor.line());
        terminal.show("> ");
      } else if (event == Event::kDamagedLine) {
        lines.push_back("!" + std::string(editor.line()));
        terminal.show("> ");
      } else if (event == Event::kInterrupt) {
        lines.emplace_back("^C");
      }
    }
    return lines;
  }

  LineEditor editor;
  Terminal terminal;
  std::string shown;
};

TEST(LineEditor, ReturnLineFeedAndBothEndOneLine) {
  Typist typist;
  EXPECT_THAT(typist.type("a\rb\nc\r\nd\n\n"), ElementsAre("a", "b", "c", "d", ""));
}

TEST(LineEditor, BackspaceAndDeleteTakeOneCharacter) {
  Typist typist;
  EXPECT_THAT(typist.type("stx\batus\x7fs\r"), ElementsAre("status"));
  EXPECT_THAT(typist.type("\b\b\x7fok\r"), ElementsAre("ok"));
  EXPECT_THAT(typist.type("hexlp\x1b[D\x1b[D\x1b[D\x1b[3~\r"), ElementsAre("help"));
}

TEST(LineEditor, ArrowsHomeAndEndMoveAndTheScreenFollows) {
  Typist typist;
  typist.type("oto\x1b[Hg\x1b[F home\x1b[D\x1b[D");
  EXPECT_EQ(typist.terminal.line(), "> goto home");
  EXPECT_EQ(typist.terminal.cursor(), std::string("> goto ho").size());
  EXPECT_THAT(typist.type("X\x1b[C\x01Y\x05Z\r"), ElementsAre("Ygoto hoXmeZ"));
  EXPECT_THAT(typist.type("bc\x1bOHa\r"), ElementsAre("abc"));
}

TEST(LineEditor, UpAndDownWalkThroughTheHistory) {
  Typist typist;
  typist.type("first\rsecond\rsecond\r\r");
  typist.type("\x1b[A");
  EXPECT_EQ(typist.terminal.line(), "> second");
  typist.type("\x1b[A");
  EXPECT_EQ(typist.terminal.line(), "> first");
  typist.type("\x1b[A");
  EXPECT_EQ(typist.terminal.line(), "> first");
  typist.type("\x1b[B");
  EXPECT_EQ(typist.terminal.line(), "> second");
  EXPECT_THAT(typist.type("\x1b[Bnew\r"), ElementsAre("new"));
}

TEST(LineEditor, TheHistoryForgetsTheOldestLine) {
  Typist typist;
  for (std::size_t i = 0; i < History::kLines + 4; ++i) {
    typist.type("line" + std::to_string(i) + "\r");
  }
  std::string keys;
  for (std::size_t i = 0; i < History::kLines + 4; ++i) {
    keys += "\x1b[A";
  }
  EXPECT_THAT(typist.type(keys + "\r"), ElementsAre("line4"));
}

TEST(LineEditor, ControlUAndControlCForgetTheLine) {
  Typist typist;
  EXPECT_THAT(typist.type("nonsense\x15help\r"), ElementsAre("help"));
  EXPECT_THAT(typist.type("nonsense\x03quit\r"), ElementsAre("^C", "quit"));
}

TEST(LineEditor, ALineTooLongIsDamagedAndNeverCutShort) {
  Typist typist;
  const std::string longest(kMaxLineLength, 'a');
  EXPECT_THAT(typist.type(longest + "\r"), ElementsAre(longest));
  EXPECT_THAT(typist.type(longest + "b\r"), ElementsAre("!" + longest));
  EXPECT_THAT(typist.type("help\r"), ElementsAre("help"));
}

TEST(LineEditor, BytesNoCommandIsMadeOfDamageTheLine) {
  for (const char byte : {'\x00', '\x02', '\x80', '\xff', '\x1f'}) {
    Typist typist;
    EXPECT_THAT(typist.type(std::string("he") + byte + "lp\r"), ElementsAre("!help"));
    EXPECT_THAT(typist.type(std::string("he") + byte + "\x15help\r"), ElementsAre("help"));
  }
}

TEST(LineEditor, WithoutEchoItShowsNothing) {
  Typist typist;
  typist.editor.set_echo(false);
  EXPECT_THAT(typist.type("abc\x7f\x1b[A\x1b[D\x80\x15stat\rus\r"), ElementsAre("stat", "us"));
  EXPECT_EQ(typist.shown, "");
}

TEST(LineEditor, WhatTheTerminalShowsIsWhatWillBeExecuted) {
  core::Random random(7);
  Typist typist;
  static constexpr std::string_view kKeys[] = {"a",       "b",      " ",      "7",      "\b",
                                               "\x7f",    "\x1b[A", "\x1b[B", "\x1b[C", "\x1b[D",
                                               "\x1b[3~", "\x01",   "\x05",   "\t"};
  for (int i = 0; i < 20'000; ++i) {
    typist.type(kKeys[random.bits() % std::size(kKeys)]);
    ASSERT_EQ(typist.terminal.line(), "> " + std::string(typist.editor.line()));
    if (random.bits() % 40 == 0) {
      const std::string expected = typist.terminal.line().substr(2);
      ASSERT_THAT(typist.type("\r"), ElementsAre(expected));
    }
  }
}

std::vector<std::string> words(std::string_view line) {
  const auto tokens = split_line(line);
  EXPECT_TRUE(tokens) << line;
  return tokens ? std::vector<std::string>(tokens->begin(), tokens->end())
                : std::vector<std::string>{};
}

TEST(Tokens, AreWordsBetweenBlanks) {
  EXPECT_THAT(words("  run\t-trapez  y "), ElementsAre("run", "-trapez", "y"));
  EXPECT_THAT(words("run --speed=0.4m/s"), ElementsAre("run", "--speed", "0.4m/s"));
  EXPECT_THAT(words("a=b"), ElementsAre("a=b"));
  EXPECT_THAT(words(""), ElementsAre());
}

TEST(Tokens, RefuseOtherBytesAndTooManyWords) {
  EXPECT_FALSE(split_line("run \x01 y"));
  EXPECT_FALSE(split_line("run\x7f"));
  EXPECT_FALSE(split_line("r\xc3\xbcn"));
  std::string many;
  for (std::size_t i = 0; i < kMaxTokens; ++i) {
    many += "a ";
  }
  EXPECT_TRUE(split_line(many));
  EXPECT_FALSE(split_line(many + "a"));
  EXPECT_FALSE(split_line(many.substr(2) + "--a=b"));
}

}  // namespace
}  // namespace towbench::bbmc
