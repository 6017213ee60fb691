#include "emulator/sensors/force_sensor.h"

namespace towbench::emulator {
namespace {

using core::Axis;

AnalogChannel force_channel(const ForceSensorParameters& p, std::uint64_t seed) noexcept {
  return {p.bandwidth_Hz, p.force_bias_deviation_N, p.force_noise_rms_N, seed};
}

AnalogChannel torque_channel(const ForceSensorParameters& p, std::uint64_t seed) noexcept {
  return {p.bandwidth_Hz, p.torque_bias_deviation_Nm, p.torque_noise_rms_Nm, seed};
}

}  // namespace

ForceSensor::ForceSensor(const ForceSensorParameters& p, std::uint64_t seed) noexcept
    : parameters_(p),
      force_{force_channel(p, seed), force_channel(p, seed + 1), force_channel(p, seed + 2)},
      torque_{torque_channel(p, seed + 3), torque_channel(p, seed + 4),
              torque_channel(p, seed + 5)},
      clock_(p.sample_period_s) {}

bool ForceSensor::step(core::Nanoseconds now_ns, const core::PerPlanarAxis<double>& load_N,
                       const core::PerPlanarAxis<double>& acceleration_m_per_s2,
                       protocol::ForceSample& sample) noexcept {
  const double mass_kg = parameters_.load_mass_kg;
  const double x_N = load_N[Axis::kX] - mass_kg * acceleration_m_per_s2[Axis::kX];
  const double y_N = load_N[Axis::kY] - mass_kg * acceleration_m_per_s2[Axis::kY];
  const double lever_m = parameters_.lever_m;
  const std::array<double, 3> force{x_N, y_N, 0.0};
  // (0, 0, -h) x (F_x, F_y, 0)
  const std::array<double, 3> torque{lever_m * y_N, -lever_m * x_N, 0.0};
  for (std::size_t i = 0; i < 3; ++i) {
    force_[i].step(force[i]);
    torque_[i].step(torque[i]);
  }
  if (!clock_.due(now_ns)) {
    return false;
  }
  sample.time_ns = now_ns;
  for (std::size_t i = 0; i < 3; ++i) {
    sample.force_N[i] = static_cast<float>(force_[i].sample());
    sample.torque_Nm[i] = static_cast<float>(torque_[i].sample());
  }
  return true;
}

}  // namespace towbench::emulator
