// Any baud rate, not only the standard ones (Linux: termios2 with BOTHER).
#pragma once

#include <cstdint>

#include "core/result.h"

namespace towbench::protocol {

// Sets both directions and returns what the driver made of it. kTransportFailed when it refuses.
[[nodiscard]] core::Result<std::uint32_t> set_any_baud(int descriptor, std::uint32_t baud) noexcept;

}  // namespace towbench::protocol
