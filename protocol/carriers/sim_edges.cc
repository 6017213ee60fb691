#include "protocol/carriers/sim_edges.h"

#include <string>
#include <string_view>

#include <fcntl.h>
#include <unistd.h>

namespace towbench::protocol {

CarrierResult<std::unique_ptr<SimEdgeDriver>> SimEdgeDriver::open(const EdgePlace& place) {
  std::unique_ptr<SimEdgeDriver> driver(new SimEdgeDriver(place.with_index));
  const unsigned count = place.with_index ? kEncoderChannelsAndIndex : kEncoderChannels;
  for (unsigned i = 0; i < count; ++i) {
    const auto path = "/sys/bus/gpio/devices/" + place.chip + "/sim_gpio" +
                      std::to_string(place.first_line + i) + "/pull";
    driver->pulls_[i] = ::open(path.c_str(), O_WRONLY | O_CLOEXEC);
    if (driver->pulls_[i] < 0 || !driver->set(i, false)) {
      return carrier_failure(core::ErrorCode::kTransportFailed,
                             place.chip + ": is no simulated GPIO chip with lines " +
                                 std::to_string(place.first_line) + " to " +
                                 std::to_string(place.first_line + count - 1) +
                                 " (gpio-sim), or no right to drive it");
    }
  }
  return driver;
}

SimEdgeDriver::~SimEdgeDriver() {
  for (unsigned i = 0; i < pulls_.size(); ++i) {
    if (pulls_[i] >= 0) {
      (void)set(i, false);
      ::close(pulls_[i]);
    }
  }
}

core::Status SimEdgeDriver::set(unsigned place, bool level) noexcept {
  const std::string_view pull = level ? "pull-up" : "pull-down";
  return ::pwrite(pulls_[place], pull.data(), pull.size(), 0) == static_cast<ssize_t>(pull.size())
             ? core::Status()
             : core::failure(core::ErrorCode::kTransportFailed);
}

}  // namespace towbench::protocol
