// The first thing that a kernel device refused: a number (core/error.h), and for the user the file
// and the reason.
//
//   ENOENT, ENODEV, ENXIO                     100 no such device
//   EBUSY                                     104 device is busy
//   EINVAL, ERANGE, EDOM                      105 device refuses the argument
//   not a number, more than the field holds   107 device has no data
//   ENOTTY, EOPNOTSUPP, a value that reads
//   back otherwise than it was written        109 device does not support the call
//   EACCES, EIO and every other               422 transport failed
#pragma once

#include <array>
#include <cstdint>
#include <string>

#include "core/error.h"
#include "core/result.h"

namespace towbench::bbmc {

enum class DeviceCall : std::uint8_t { kOpen, kRead, kWrite, kControl };

class DeviceTrouble {
 public:
  // Keeps the first one. Always a failure, for the caller to return.
  core::Status note(DeviceCall call, const std::string& path, int error) noexcept;
  // The same where the kernel had no objection but the value is wrong.
  core::Status note_value(const std::string& path, core::ErrorCode code, std::uint64_t found,
                          std::uint64_t wanted) noexcept;
  core::Status note_text(const std::string& path) noexcept;  // no number in it

  [[nodiscard]] bool any() const noexcept { return code_ != core::ErrorCode::kNone; }
  [[nodiscard]] core::ErrorCode code() const noexcept { return code_; }
  // "cannot write /sys/...: Invalid argument". Empty when there was none.
  [[nodiscard]] std::string message() const;
  void forget() noexcept { code_ = core::ErrorCode::kNone; }

 private:
  enum class Kind : std::uint8_t { kRefused, kOtherValue, kNoNumber };
  core::Status keep(Kind kind, core::ErrorCode code, const std::string& path) noexcept;

  core::ErrorCode code_ = core::ErrorCode::kNone;
  Kind kind_ = Kind::kRefused;
  DeviceCall call_ = DeviceCall::kOpen;
  std::array<char, 256> path_{};  // the end of a longer one: no memory is asked for here
  int error_ = 0;
  std::uint64_t found_ = 0;
  std::uint64_t wanted_ = 0;
};

}  // namespace towbench::bbmc
