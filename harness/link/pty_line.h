// A serial line that is nowhere but in the kernel: two pseudo-terminals and a thread that carries
// each one's bytes to the other. Real ttys at both ends, without a baud rate.
#pragma once

#include <array>
#include <string>
#include <thread>

namespace towbench::harness {

class PtyLine {
 public:
  // Throws std::system_error.
  PtyLine();
  PtyLine(const PtyLine&) = delete;
  PtyLine& operator=(const PtyLine&) = delete;
  ~PtyLine();

  // Devices of the two ends.
  [[nodiscard]] const std::string& near_end() const noexcept { return ends_[0].device; }
  [[nodiscard]] const std::string& far_end() const noexcept { return ends_[1].device; }

 private:
  struct End {
    int master = -1;
    int held = -1;  // the device, so that the line stays up while nobody else has it open
    std::string device;
  };
  static End open_end();
  void carry() noexcept;

  std::array<End, 2> ends_;
  std::array<int, 2> stop_{-1, -1};  // pipe
  std::thread carrier_;
};

}  // namespace towbench::harness
