#include "bbmc/host/linux/device_trouble.h"

#include <cerrno>
#include <system_error>

namespace towbench::bbmc {
namespace {

using core::ErrorCode;

ErrorCode code_of(int error) noexcept {
  switch (error) {
    case ENOENT:
    case ENODEV:
    case ENXIO:
      return ErrorCode::kDeviceUnknown;
    case EBUSY:
      return ErrorCode::kDeviceBusy;
    case EINVAL:
    case ERANGE:
    case EDOM:
      return ErrorCode::kDeviceBadArgument;
    case ENOTTY:
    case EOPNOTSUPP:
      return ErrorCode::kDeviceUnsupported;
    default:
      return ErrorCode::kTransportFailed;
  }
}

const char* name_of(DeviceCall call) noexcept {
  constexpr std::array<const char*, 4> kNames{"open", "read", "write", "set up"};
  return kNames[static_cast<std::size_t>(call)];
}

}  // namespace

core::Status DeviceTrouble::keep(Kind kind, ErrorCode code, const std::string& path) noexcept {
  code_ = code;
  kind_ = kind;
  path_ = {};
  const std::size_t left_out = path.size() < path_.size() ? 0 : path.size() - path_.size() + 1;
  path.copy(path_.data(), path_.size() - 1, left_out);
  return core::failure(code);
}

core::Status DeviceTrouble::note(DeviceCall call, const std::string& path, int error) noexcept {
  const ErrorCode code = code_of(error);
  if (any()) {
    return core::failure(code);
  }
  call_ = call;
  error_ = error;
  return keep(Kind::kRefused, code, path);
}

core::Status DeviceTrouble::note_value(const std::string& path, ErrorCode code, std::uint64_t found,
                                       std::uint64_t wanted) noexcept {
  if (any()) {
    return core::failure(code);
  }
  found_ = found;
  wanted_ = wanted;
  return keep(Kind::kOtherValue, code, path);
}

core::Status DeviceTrouble::note_text(const std::string& path) noexcept {
  return any() ? core::failure(ErrorCode::kDeviceNoData)
               : keep(Kind::kNoNumber, ErrorCode::kDeviceNoData, path);
}

std::string DeviceTrouble::message() const {
  if (!any()) {
    return {};
  }
  const std::string path = path_.data();
  if (kind_ == Kind::kNoNumber) {
    return path + " holds no number";
  }
  if (kind_ == Kind::kOtherValue) {
    return path + " says " + std::to_string(found_) + ", not " + std::to_string(wanted_);
  }
  return std::string("cannot ") + name_of(call_) + ' ' + path + ": " +
         std::generic_category().message(error_);
}

}  // namespace towbench::bbmc
