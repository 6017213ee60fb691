// The console of an image for a person: a pseudo-terminal, whose path any terminal program opens.
//
// What the image prints while nobody has it open waits there; beyond 64 KB the oldest is dropped.
#pragma once

#include <string>
#include <string_view>

namespace towbench::harness {

class FirmwareTerminal {
 public:
  // Throws std::system_error.
  FirmwareTerminal();
  FirmwareTerminal(const FirmwareTerminal&) = delete;
  FirmwareTerminal& operator=(const FirmwareTerminal&) = delete;
  ~FirmwareTerminal();

  [[nodiscard]] const std::string& path() const noexcept { return path_; }

  // Shows what was printed and takes what was typed; never waits.
  [[nodiscard]] std::string exchange(std::string_view printed);

 private:
  int master_ = -1;
  int held_ = -1;  // so that the terminal stays up while nobody else has it open
  std::string path_;
  std::string to_show_;
};

}  // namespace towbench::harness
