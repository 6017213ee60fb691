// One channel of a PWM chip in sysfs: exported, period, duty_cycle, polarity, enable.
#pragma once

#include <cstdint>
#include <string>

#include "bbmc/host/linux/device_trouble.h"
#include "bbmc/host/linux/linux_devices.h"
#include "bbmc/host/linux/sysfs_file.h"
#include "core/result.h"

namespace towbench::bbmc {

class PwmChannel {
 public:
  // Exports the channel where it is not, and puts nothing out: duty 0, disabled.
  [[nodiscard]] core::Status open(const LinuxPwmChannel& place, const std::string& root,
                                  DeviceTrouble& trouble);
  [[nodiscard]] bool is_open() const noexcept { return enable_.is_open(); }

  // Normal polarity and this period, with nothing put out. The device must say the same period.
  [[nodiscard]] core::Status start(std::uint64_t period_ns) noexcept;
  // Only what has changed is written.
  [[nodiscard]] core::Status set_duty(std::uint64_t duty_ns) noexcept;
  [[nodiscard]] core::Status set_enabled(bool enabled) noexcept;
  // Duty 0 and disabled: both are tried whatever the other says, and whatever was written before.
  void make_safe() noexcept;

 private:
  [[nodiscard]] core::Status export_channel(const LinuxPwmChannel& place, const std::string& chip,
                                            DeviceTrouble& trouble);

  static constexpr std::uint64_t kUnknown = ~std::uint64_t{0};

  SysfsFile export_;
  SysfsFile period_;
  SysfsFile duty_;
  SysfsFile polarity_;
  SysfsFile enable_;
  std::uint64_t duty_written_ns_ = kUnknown;
  std::uint64_t enable_written_ = kUnknown;
};

}  // namespace towbench::bbmc
