// A line of a GPIO chip. libgpiod's calls stand in chip_line.cc and nowhere else in bbmc.
#pragma once

#include <string>

#include "bbmc/host/linux/linux_line.h"

struct gpiod_chip;
struct gpiod_line;

namespace towbench::bbmc {

class ChipLine final : public LinuxLine {
 public:
  ChipLine() = default;
  ChipLine(const ChipLine&) = delete;
  ChipLine& operator=(const ChipLine&) = delete;
  ~ChipLine() override;  // an output goes inactive

  // `place` is CHIP:OFFSET. A line that somebody else holds is refused (kDeviceBusy).
  [[nodiscard]] core::Status open(const std::string& place, Direction direction, bool active_low,
                                  DeviceTrouble& trouble);

  core::Result<bool> level() noexcept override;
  core::Status drive(bool active) noexcept override;
  core::Result<bool> next_edge(LineEdge& edge) noexcept override;

 private:
  std::string place_;
  DeviceTrouble* trouble_ = nullptr;
  gpiod_chip* chip_ = nullptr;
  gpiod_line* line_ = nullptr;
  bool is_output_ = false;
};

}  // namespace towbench::bbmc
