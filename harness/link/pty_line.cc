#include "harness/link/pty_line.h"

#include <cerrno>
#include <cstddef>
#include <cstdlib>
#include <system_error>

#include <fcntl.h>
#include <poll.h>
#include <termios.h>
#include <unistd.h>

namespace towbench::harness {
namespace {

int must_open(int result, const char* what) {
  if (result < 0) {
    throw std::system_error(errno, std::generic_category(), what);
  }
  return result;
}

// All of it: a line loses nothing.
bool write_whole(int file, const char* bytes, std::size_t size) noexcept {
  for (std::size_t sent = 0; sent < size;) {
    const auto count = write(file, bytes + sent, size - sent);
    if (count < 0 && errno != EINTR) {
      return false;
    }
    sent += count > 0 ? static_cast<std::size_t>(count) : 0;
  }
  return true;
}

}  // namespace

PtyLine::End PtyLine::open_end() {
  End end;
  end.master = must_open(posix_openpt(O_RDWR | O_NOCTTY | O_CLOEXEC), "posix_openpt");
  std::array<char, 64> name{};
  must_open(grantpt(end.master), "grantpt");
  must_open(unlockpt(end.master), "unlockpt");
  if (const int error = ptsname_r(end.master, name.data(), name.size()); error != 0) {
    throw std::system_error(error, std::generic_category(), "ptsname_r");
  }
  end.device = name.data();
  end.held = must_open(open(end.device.c_str(), O_RDWR | O_NOCTTY | O_CLOEXEC), "open");
  termios raw{};
  must_open(tcgetattr(end.held, &raw), "tcgetattr");
  cfmakeraw(&raw);
  must_open(tcsetattr(end.held, TCSANOW, &raw), "tcsetattr");
  return end;
}

PtyLine::PtyLine() : ends_{open_end(), open_end()} {
  must_open(pipe2(stop_.data(), O_CLOEXEC), "pipe");
  carrier_ = std::thread([this] { carry(); });
}

PtyLine::~PtyLine() {
  close(stop_[1]);  // ends the thread's poll
  carrier_.join();
  close(stop_[0]);
  for (const End& end : ends_) {
    close(end.held);
    close(end.master);
  }
}

void PtyLine::carry() noexcept {
  std::array<char, 65536> bytes;
  while (true) {
    std::array<pollfd, 3> waiting{
        {{ends_[0].master, POLLIN, 0}, {ends_[1].master, POLLIN, 0}, {stop_[0], POLLIN, 0}}};
    if (poll(waiting.data(), waiting.size(), -1) < 0 && errno != EINTR) {
      return;
    }
    if (waiting[2].revents != 0) {
      return;
    }
    for (std::size_t i = 0; i < 2; ++i) {
      if ((waiting[i].revents & POLLIN) == 0) {
        continue;
      }
      const auto count = read(ends_[i].master, bytes.data(), bytes.size());
      if (count > 0 &&
          !write_whole(ends_[1 - i].master, bytes.data(), static_cast<std::size_t>(count))) {
        return;
      }
    }
  }
}

}  // namespace towbench::harness
