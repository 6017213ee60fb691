// Ctrl-C and SIGTERM as a flag: the run in progress ends orderly.
#pragma once

#include <atomic>

namespace towbench::harness {

// Installs the handlers at the first call.
[[nodiscard]] const std::atomic<bool>& stop_requested();

}  // namespace towbench::harness
