// A GPIO chip that the kernel simulates (gpio-sim), made through its file system of configurations.
#pragma once

#include <filesystem>
#include <fstream>
#include <string>

namespace towbench::protocol {

class SimulatedChip {
 public:
  explicit SimulatedChip(unsigned lines) {
    std::filesystem::create_directory(device_);
    std::filesystem::create_directory(device_ / "bank0");
    write("bank0/num_lines", std::to_string(lines));
    write("live", "1");
    std::ifstream(device_ / "bank0/chip_name") >> name_;
  }
  SimulatedChip(const SimulatedChip&) = delete;
  SimulatedChip& operator=(const SimulatedChip&) = delete;
  ~SimulatedChip() {
    write("live", "0");
    std::filesystem::remove(device_ / "bank0");
    std::filesystem::remove(device_);
  }
  [[nodiscard]] const std::string& name() const { return name_; }
  static bool is_possible() { return std::filesystem::exists("/sys/kernel/config/gpio-sim"); }

 private:
  void write(const char* file, const std::string& text) const {
    std::ofstream(device_ / file) << text;
  }
  std::filesystem::path device_ = "/sys/kernel/config/gpio-sim/towbench-test";
  std::string name_;
};

}  // namespace towbench::protocol
