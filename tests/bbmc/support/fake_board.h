// A folder that imitates the kernel's devices of a board: two counters, four PWM channels, nine
// lines as files. Goes with its object.
#pragma once

#include <cstdint>
#include <filesystem>
#include <map>
#include <string>

#include "bbmc/device/gpio.h"
#include "bbmc/host/linux/linux_devices.h"

namespace towbench::tests {

class FakeBoard {
 public:
  FakeBoard();
  FakeBoard(const FakeBoard&) = delete;
  FakeBoard& operator=(const FakeBoard&) = delete;
  ~FakeBoard();

  // Everything wired to this folder.
  [[nodiscard]] const bbmc::LinuxDevices& devices() const noexcept { return devices_; }
  [[nodiscard]] const std::filesystem::path& root() const noexcept { return root_; }

  // Paths below the root.
  [[nodiscard]] static std::string count_file(core::Axis axis);
  // `channel` 0 drives towards max, 1 towards min.
  [[nodiscard]] static std::string pwm_file(core::Axis axis, unsigned channel, const char* name);
  [[nodiscard]] static std::string line_file(bbmc::Line line);

  void write(const std::string& file, const std::string& text) const;
  void write(const std::string& file, std::uint64_t number) const;
  [[nodiscard]] std::uint64_t read(const std::string& file) const;
  [[nodiscard]] std::string first_line(const std::string& file) const;

  // Whether nothing is put out: every duty 0, every channel disabled, both amplifiers off.
  [[nodiscard]] bool is_safe() const;

  // From now on `file` refuses what it is asked for, in place of what was there. Before it is
  // opened:
  void refuse_every_write(const std::string& file) const;  // no space left
  void refuse_the_value(const std::string& file) const;    // invalid argument
  // While it is open: the object that is returned decides when.
  class Seal {
   public:
    explicit Seal(int descriptor) noexcept : descriptor_(descriptor) {}
    Seal(const Seal&) = delete;
    Seal& operator=(const Seal&) = delete;
    ~Seal();
    void close_for_writing() const;  // permission denied

   private:
    int descriptor_;
  };
  [[nodiscard]] Seal sealable(const std::string& file) const;

 private:
  // Kept open: a closed loop reads and writes them a thousand times a second.
  [[nodiscard]] int descriptor_of(const std::string& file) const;
  void replace(const std::string& file, const std::string& target) const;

  std::filesystem::path root_;
  mutable std::map<std::string, int> open_;
  bbmc::LinuxDevices devices_;
};

}  // namespace towbench::tests
