#include "emulator/sensors/analog_channel.h"

#include <numbers>

#include "core/deterministic_math.h"
#include "core/time.h"

namespace towbench::emulator {

AnalogChannel::AnalogChannel(double bandwidth_Hz, double bias_deviation, double noise_rms,
                             std::uint64_t seed) noexcept
    : random_(seed),
      share_(1.0 - core::exponential(-2.0 * std::numbers::pi * bandwidth_Hz * core::kPlantTick_s)),
      noise_rms_(noise_rms),
      bias_(bias_deviation * random_.gaussian()) {}

}  // namespace towbench::emulator
