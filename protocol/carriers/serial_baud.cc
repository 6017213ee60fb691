#include "protocol/carriers/serial_baud.h"

// The kernel's own termios2; it and <termios.h> cannot be included together, hence this file.
#include <asm/termbits.h>
#include <sys/ioctl.h>

namespace towbench::protocol {

core::Result<std::uint32_t> set_any_baud(int descriptor, std::uint32_t baud) noexcept {
  termios2 settings{};
  if (::ioctl(descriptor, TCGETS2, &settings) != 0) {
    return core::failure(core::ErrorCode::kTransportFailed);
  }
  settings.c_cflag &= ~static_cast<tcflag_t>(CBAUD | (CBAUD << IBSHIFT));
  settings.c_cflag |= static_cast<tcflag_t>(BOTHER | (BOTHER << IBSHIFT));
  settings.c_ispeed = baud;
  settings.c_ospeed = baud;
  if (::ioctl(descriptor, TCSETS2, &settings) != 0 ||
      ::ioctl(descriptor, TCGETS2, &settings) != 0) {
    return core::failure(core::ErrorCode::kTransportFailed);
  }
  return settings.c_ospeed;
}

}  // namespace towbench::protocol
