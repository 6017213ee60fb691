// A line as a file that holds 0 or 1: the kernel's older face of a GPIO, or a folder that imitates
// one.
#pragma once

#include <string>

#include "bbmc/host/linux/linux_line.h"
#include "bbmc/host/linux/sysfs_file.h"

namespace towbench::bbmc {

class FileLine final : public LinuxLine {
 public:
  [[nodiscard]] core::Status open(const std::string& path, Direction direction, bool active_low,
                                  DeviceTrouble& trouble) {
    trouble_ = &trouble;
    active_low_ = active_low;
    const bool out = direction == Direction::kOut;
    const auto access = out ? SysfsFile::Access::kWrite : SysfsFile::Access::kRead;
    const auto opened = file_.open(path, access, trouble);
    return opened && out ? drive(false) : opened;
  }

  core::Result<bool> level() noexcept override {
    const auto number = file_.read_number();
    if (!number) {
      return core::failure(number.error());
    }
    if (*number > 1) {
      return core::failure(
          trouble_->note_value(file_.path(), core::ErrorCode::kDeviceNoData, *number, 1).error());
    }
    return (*number == 1) != active_low_;
  }
  core::Status drive(bool active) noexcept override {
    return file_.write_number(active != active_low_ ? 1 : 0);
  }
  core::Result<bool> next_edge(LineEdge& /*edge*/) noexcept override { return false; }

 private:
  SysfsFile file_;
  DeviceTrouble* trouble_ = nullptr;
  bool active_low_ = false;
};

}  // namespace towbench::bbmc
