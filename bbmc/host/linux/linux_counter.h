// eQEP behind the kernel's counter subsystem: quadrature x4, counted by hardware, read once an
// exchange. The AM335x's driver reports no capture and no illegal transitions, so the period is
// sampled (sampled_capture.h), and the counter of illegal transitions stays 0.
#pragma once

#include <cstdint>

#include "bbmc/device/eqep.h"
#include "bbmc/host/linux/index_events.h"
#include "bbmc/host/linux/linux_devices.h"
#include "bbmc/host/linux/sampled_capture.h"
#include "bbmc/host/linux/sysfs_file.h"

namespace towbench::bbmc {

class LinuxCounter final : public EqepPort {
 public:
  // Opens the files; the device still counts as it did. `trouble` outlives this.
  [[nodiscard]] core::Status open(const LinuxEncoderPlace& place, const std::string& root,
                                  DeviceTrouble& trouble);
  // A count that is never asked for stays 0: an axis that does not exist.
  [[nodiscard]] bool is_open() const noexcept { return count_.is_open(); }

  // Reads the count and what waits of index pulses.
  [[nodiscard]] core::Status sample(core::Nanoseconds now_ns) noexcept;
  [[nodiscard]] IndexEvents& index_events() noexcept { return index_; }

  // ---- the driver's side: no system call but in apply() ----
  // Quadrature x4, ceiling, counting on; each is read back.
  core::Status apply(const Eqep::Settings& settings) noexcept override;
  core::Status read(Eqep::Reading& reading) noexcept override;
  // By an offset: writing the device's count would lose the edges between reading and writing.
  core::Status write(const Eqep::Command& command) noexcept override;
  void release() noexcept override {}

 private:
  // Of a reading of the device, unwrapped from where the count stands; signed towards max.
  [[nodiscard]] std::int64_t unwrapped(std::uint64_t raw) const noexcept;
  [[nodiscard]] std::uint32_t position_of(std::int64_t total) const noexcept;
  [[nodiscard]] core::Status take_index_pulses() noexcept;

  SysfsFile count_;
  SysfsFile ceiling_file_;
  SysfsFile enable_;
  SysfsFile function_;
  IndexEvents index_;
  DeviceTrouble* trouble_ = nullptr;
  std::uint64_t ceiling_ = 0xFFFF'FFFFU;
  bool inverted_ = false;
  Eqep::Settings settings_;
  SampledCapture capture_;
  core::Nanoseconds time_ns_ = 0;
  std::uint64_t raw_ = 0;
  std::int64_t total_ = 0;
  std::int64_t offset_ = 0;
  std::uint32_t index_pulses_ = 0;
  std::int64_t index_total_ = 0;
  bool set_up_ = false;
  bool started_ = false;
};

}  // namespace towbench::bbmc
