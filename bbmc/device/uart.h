// UART: bytes of the console, a small chunk at a time.
#pragma once

#include <cstdint>
#include <string_view>

#include "bbmc/device/driver.h"
#include "core/bounded_vector.h"

namespace towbench::bbmc {

struct Uart {
  static constexpr std::string_view kName = "uart";
  static constexpr std::size_t kChunk = 64;  // depth of the AM335x's FIFO

  using Chunk = core::BoundedVector<char, kChunk>;

  struct Settings {
    std::uint32_t baud = 115'200;
    friend bool operator==(const Settings&, const Settings&) = default;
  };
  // Received bytes, oldest first; kDeviceNoData when there are none.
  using Reading = Chunk;
  // All or nothing: kDeviceFull, and nothing taken, when the chunk does not fit.
  using Command = Chunk;

  [[nodiscard]] static constexpr bool valid(const Settings& settings) noexcept {
    return settings.baud >= 300 && settings.baud <= 12'000'000;
  }
  [[nodiscard]] static bool valid(const Command& command, const Settings& /*settings*/) noexcept {
    return !command.empty();
  }
};

using UartDriver = Driver<Uart>;
using UartPort = Port<Uart>;

}  // namespace towbench::bbmc
