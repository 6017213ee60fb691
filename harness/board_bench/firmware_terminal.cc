#include "harness/board_bench/firmware_terminal.h"

#include <array>
#include <cerrno>
#include <cstdlib>
#include <system_error>

#include <fcntl.h>
#include <termios.h>
#include <unistd.h>

namespace towbench::harness {
namespace {

constexpr std::size_t kMostWaiting = 65'536;

int must(int result, const char* what) {
  if (result < 0) {
    throw std::system_error(errno, std::generic_category(), what);
  }
  return result;
}

}  // namespace

FirmwareTerminal::FirmwareTerminal() {
  master_ = must(posix_openpt(O_RDWR | O_NOCTTY | O_CLOEXEC | O_NONBLOCK), "posix_openpt");
  must(grantpt(master_), "grantpt");
  must(unlockpt(master_), "unlockpt");
  std::array<char, 64> name{};
  if (const int error = ptsname_r(master_, name.data(), name.size()); error != 0) {
    throw std::system_error(error, std::generic_category(), "ptsname_r");
  }
  path_ = name.data();
  held_ = must(open(path_.c_str(), O_RDWR | O_NOCTTY | O_CLOEXEC), "open");
  termios raw{};
  must(tcgetattr(held_, &raw), "tcgetattr");
  cfmakeraw(&raw);
  must(tcsetattr(held_, TCSANOW, &raw), "tcsetattr");
}

FirmwareTerminal::~FirmwareTerminal() {
  if (held_ >= 0) {
    close(held_);
  }
  if (master_ >= 0) {
    close(master_);
  }
}

std::string FirmwareTerminal::exchange(std::string_view printed) {
  to_show_ += printed;
  if (!to_show_.empty()) {
    if (const auto shown = write(master_, to_show_.data(), to_show_.size()); shown > 0) {
      to_show_.erase(0, static_cast<std::size_t>(shown));
    }
    if (to_show_.size() > kMostWaiting) {
      to_show_.erase(0, to_show_.size() - kMostWaiting);
    }
  }
  std::array<char, 256> bytes{};
  const auto count = read(master_, bytes.data(), bytes.size());
  return {bytes.data(), count > 0 ? static_cast<std::size_t>(count) : 0};
}

}  // namespace towbench::harness
