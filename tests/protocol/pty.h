// A pseudo-terminal pair: a real tty for the port under test, and the other end of its line.
#pragma once

#include <array>
#include <filesystem>

#include <fcntl.h>
#include <stdlib.h>
#include <unistd.h>

namespace towbench::protocol {

class Pty {
 public:
  Pty() : far_end_(::posix_openpt(O_RDWR | O_NOCTTY)) {
    std::array<char, 64> name{};
    if (::grantpt(far_end_) == 0 && ::unlockpt(far_end_) == 0 &&
        ::ptsname_r(far_end_, name.data(), name.size()) == 0) {
      path_ = name.data();
    }
  }
  ~Pty() { unplug(); }
  Pty(const Pty&) = delete;
  Pty& operator=(const Pty&) = delete;

  [[nodiscard]] const std::filesystem::path& path() const { return path_; }
  [[nodiscard]] int far_end() const { return far_end_; }

  void unplug() {
    if (far_end_ >= 0) {
      ::close(far_end_);
      far_end_ = -1;
    }
  }

 private:
  int far_end_;
  std::filesystem::path path_;
};

}  // namespace towbench::protocol
