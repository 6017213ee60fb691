#include "bbmc/host/linux/sysfs_file.h"

#include <array>
#include <cerrno>
#include <charconv>
#include <utility>

#include <fcntl.h>
#include <unistd.h>

namespace towbench::bbmc {
namespace {

using core::ErrorCode;
using core::failure;

constexpr std::size_t kLongestLine = 64;

}  // namespace

SysfsFile::~SysfsFile() {
  if (descriptor_ >= 0) {
    ::close(descriptor_);
  }
}

core::Status SysfsFile::open(std::string path, Access access, DeviceTrouble& trouble) {
  path_ = std::move(path);
  trouble_ = &trouble;
  const int mode = access == Access::kRead    ? O_RDONLY
                   : access == Access::kWrite ? O_WRONLY
                                              : O_RDWR;
  descriptor_ = ::open(path_.c_str(), mode | O_CLOEXEC);
  return descriptor_ >= 0 ? core::Status() : trouble.note(DeviceCall::kOpen, path_, errno);
}

core::Result<std::uint64_t> SysfsFile::read_number() noexcept {
  std::array<char, kLongestLine> text{};
  const ssize_t size = ::pread(descriptor_, text.data(), text.size(), 0);
  if (size < 0) {
    return failure(trouble_->note(DeviceCall::kRead, path_, errno).error());
  }
  const char* const end = text.data() + size;
  std::uint64_t number = 0;
  const auto [rest, error] = std::from_chars(text.data(), end, number);
  // Sysfs ends a value with a line; what stands after it is no number.
  if (error != std::errc() || (rest != end && *rest != '\n')) {
    return failure(trouble_->note_text(path_).error());
  }
  return number;
}

core::Status SysfsFile::write_number(std::uint64_t number) noexcept {
  std::array<char, kLongestLine> text{};
  char* const end = std::to_chars(text.data(), text.data() + text.size(), number).ptr;
  return write_text({text.data(), static_cast<std::size_t>(end - text.data())});
}

core::Status SysfsFile::write_text(std::string_view line) noexcept {
  std::array<char, kLongestLine> text{};
  if (line.size() + 1 > text.size()) {
    return trouble_->note(DeviceCall::kWrite, path_, EINVAL);
  }
  line.copy(text.data(), line.size());
  text[line.size()] = '\n';
  const std::size_t size = line.size() + 1;
  const ssize_t written = ::pwrite(descriptor_, text.data(), size, 0);
  if (written != static_cast<ssize_t>(size)) {
    return trouble_->note(DeviceCall::kWrite, path_, written < 0 ? errno : EIO);
  }
  return {};
}

core::Status SysfsFile::settle_number(std::uint64_t number) noexcept {
  if (const auto written = write_number(number); !written) {
    return written;
  }
  const auto found = read_number();
  if (!found) {
    return failure(found.error());
  }
  return *found == number
             ? core::Status()
             : trouble_->note_value(path_, ErrorCode::kDeviceUnsupported, *found, number);
}

}  // namespace towbench::bbmc
