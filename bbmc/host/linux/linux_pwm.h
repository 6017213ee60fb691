// eHRPWM behind sysfs: the two channels of one axis, never both above 0.
#pragma once

#include <cstdint>
#include <string>

#include "bbmc/device/ehrpwm.h"
#include "bbmc/host/linux/linux_devices.h"
#include "bbmc/host/linux/pwm_channel.h"

namespace towbench::bbmc {

class LinuxPwm final : public EhrpwmPort {
 public:
  // Nothing is put out afterwards. `trouble` outlives this.
  [[nodiscard]] core::Status open(const LinuxPwmPlace& place, const std::string& root,
                                  DeviceTrouble& trouble);
  [[nodiscard]] bool is_open() const noexcept { return towards_min_.is_open(); }

  // Puts out what the driver has written. The channel that goes to 0 does so before the other
  // rises.
  [[nodiscard]] core::Status flush() noexcept;
  void make_safe() noexcept;

  // ---- the driver's side: no system call but in apply() and release() ----
  core::Status apply(const Ehrpwm::Settings& settings) noexcept override;
  core::Status read(Ehrpwm::Reading& reading) noexcept override;
  core::Status write(const Ehrpwm::Command& command) noexcept override;
  void release() noexcept override { make_safe(); }

 private:
  [[nodiscard]] std::uint64_t ns_of(std::uint16_t ticks) const noexcept;

  PwmChannel towards_max_;
  PwmChannel towards_min_;
  double tick_ns_ = 10;
  Ehrpwm::Command wanted_;
};

}  // namespace towbench::bbmc
