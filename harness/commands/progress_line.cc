#include "harness/commands/progress_line.h"

#include <cstdio>

#include <unistd.h>

namespace towbench::harness {

ProgressLine::ProgressLine(std::string name, double limit_s, bool wanted)
    : name_(std::move(name)), limit_s_(limit_s), wanted_(wanted && isatty(STDERR_FILENO) == 1) {}

ProgressLine::~ProgressLine() {
  if (shown_) {
    std::fputs("\r\033[K", stderr);
  }
}

void ProgressLine::show(core::Nanoseconds virtual_time_ns) {
  constexpr auto kPatience = std::chrono::seconds(2);
  constexpr auto kBetween = std::chrono::milliseconds(200);
  const auto now = Clock::now();
  if (!wanted_ || now - start_ < kPatience || now - last_ < kBetween) {
    return;
  }
  last_ = now;
  shown_ = true;
  const double elapsed_s = std::chrono::duration<double>(now - start_).count();
  const double virtual_s = core::seconds(virtual_time_ns);
  std::fprintf(stderr, "\r%s: %.1f s of at most %.1f s simulated, %.0f x real time\033[K",
               name_.c_str(), virtual_s, limit_s_, virtual_s / elapsed_s);
  std::fflush(stderr);
}

}  // namespace towbench::harness
