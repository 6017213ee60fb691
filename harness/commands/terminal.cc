#include "harness/commands/terminal.h"

#include <array>

#include <poll.h>
#include <unistd.h>

namespace towbench::harness {

Terminal::Terminal() {
  termios settings{};
  if (isatty(STDIN_FILENO) != 1 || tcgetattr(STDIN_FILENO, &settings) != 0) {
    return;
  }
  saved_ = settings;
  cfmakeraw(&settings);
  settings.c_oflag |= OPOST;  // messages of this program keep their line ends
  tcsetattr(STDIN_FILENO, TCSANOW, &settings);
}

Terminal::~Terminal() {
  if (saved_) {
    tcsetattr(STDIN_FILENO, TCSANOW, &*saved_);
  }
}

std::string Terminal::read() {
  pollfd ready{STDIN_FILENO, POLLIN, 0};
  if (at_end_ || ::poll(&ready, 1, 0) <= 0) {
    return {};
  }
  std::array<char, 512> bytes{};
  const auto count = ::read(STDIN_FILENO, bytes.data(), bytes.size());
  at_end_ = count == 0;
  return {bytes.data(), count > 0 ? static_cast<std::size_t>(count) : 0};
}

}  // namespace towbench::harness
