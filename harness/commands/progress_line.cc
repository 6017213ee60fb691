#include "harness/commands/progress_line.h"

#include <cstdio>

#include <fmt/format.h>
#include <unistd.h>

namespace towbench::harness {

ProgressLine::ProgressLine(bool wanted) : wanted_(wanted && isatty(STDERR_FILENO) == 1) {}

void ProgressLine::show(const std::string& text) {
  if (wanted_) {
    shown_ = true;
    std::fprintf(stderr, "\r%s\033[K", text.c_str());
    std::fflush(stderr);
  }
}

void ProgressLine::show(const std::string& what, double share) {
  show(fmt::format("{}: {:.0f} %", what, 100 * share));
}

void ProgressLine::show_sometimes(const std::function<std::string()>& text) {
  constexpr auto kPatience = std::chrono::seconds(2);
  constexpr auto kBetween = std::chrono::milliseconds(200);
  const auto now = Clock::now();
  if (wanted_ && now - start_ >= kPatience && now - last_ >= kBetween) {
    last_ = now;
    show(text());
  }
}

void ProgressLine::clear() {
  if (shown_) {
    shown_ = false;
    std::fputs("\r\033[K", stderr);
  }
}

double ProgressLine::elapsed_s() const {
  return std::chrono::duration<double>(Clock::now() - start_).count();
}

}  // namespace towbench::harness
