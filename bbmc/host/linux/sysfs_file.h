// One attribute of a device in sysfs, kept open: read and written whole, from its beginning, by one
// system call each.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>

#include "bbmc/host/linux/device_trouble.h"
#include "core/result.h"

namespace towbench::bbmc {

class SysfsFile {
 public:
  enum class Access : std::uint8_t { kRead, kWrite, kReadWrite };

  SysfsFile() noexcept = default;
  SysfsFile(const SysfsFile&) = delete;
  SysfsFile& operator=(const SysfsFile&) = delete;
  ~SysfsFile();

  // What goes wrong is noted in `trouble`, which outlives this, here and in every later call.
  [[nodiscard]] core::Status open(std::string path, Access access, DeviceTrouble& trouble);
  [[nodiscard]] bool is_open() const noexcept { return descriptor_ >= 0; }
  [[nodiscard]] const std::string& path() const noexcept { return path_; }

  // The number on the first line; kDeviceNoData where there is none.
  [[nodiscard]] core::Result<std::uint64_t> read_number() noexcept;
  [[nodiscard]] core::Status write_number(std::uint64_t number) noexcept;
  [[nodiscard]] core::Status write_text(std::string_view line) noexcept;
  // Written and read back: kDeviceUnsupported where the device says something else.
  [[nodiscard]] core::Status settle_number(std::uint64_t number) noexcept;

 private:
  std::string path_;
  DeviceTrouble* trouble_ = nullptr;
  int descriptor_ = -1;
};

}  // namespace towbench::bbmc
