#include "bbmc/system/axis_configuration.h"

namespace towbench::bbmc {

AxisConfiguration x_axis_defaults() noexcept {
  AxisConfiguration x;
  x.sprocket_radius_m = 0.030;    // firmware
  x.speed_limit_m_per_s = 0.382;  // at the voltage limit
  x.gains = {.proportional_Nm_per_rad = 0.06,
             .integral_Nm_per_rad_s = 0.4,
             .derivative_Nm_s_per_rad = 8e-4};
  x.feed_forward.inertia_kg_m2 = 2.0e-6;                                 // assumed
  x.feed_forward.viscous_friction_Nm_s_per_rad = 4e-6;                   // assumed
  x.feed_forward.coulomb_friction_Nm = 1.6e-3;                           // assumed
  x.friction = {.breakaway_Nm = 2.4e-3,                                  // assumed
                .coulomb_friction_Nm = 1.6e-3,                           // assumed
                .viscous_friction_Nm_s_per_rad = 4e-6};                  // assumed
  x.disturbance_observer = {.inertia_kg_m2 = 1.3e-6, .limit_Nm = 5e-3};  // assumed
  x.nonlinear_observer.inertia_kg_m2 = 1.3e-6;                           // assumed
  x.nonlinear_observer.limit_Nm = 5e-3;                                  // assumed
  x.state_observer.load_Nm_per_sqrt_s = 6e-3;  // assumed, as break-away: 2/3 of Y's
  x.state_observer.torque_noise_Nm = 3e-4;     // assumed
  x.chain.carriage_friction_Nm = 1.04e-3;      // 0.65 C, assumed
  x.homing.carriage_friction_Nm = 1.56e-3;     // 0.65 of break-away, assumed
  x.drive.torque_constant_Nm_per_A = 23.5e-3;  // assumed
  x.ends = {.hard_min_count = 0,
            .hard_max_count = 505'000,  // firmware
            .hall_min_count = 1'000,
            .hall_max_count = 500'000,
            .soft_min_count = 50'000,
            .soft_max_count = 450'000};
  x.braking.inertia_kg_m2 = 2.0e-6;        // assumed
  x.braking.rotor_inertia_kg_m2 = 1.3e-6;  // assumed
  x.braking.held_motor_chain_Hz = 17.7;    // assumed 22 Hz free-free, carriage on a held motor
  x.braking.speed_gain_Nm_s_per_rad = 8e-4;
  x.braking.standstill_m_per_s = 0.7e-3;       // 500 counts/s
  x.plausibility.worst_breakaway_Nm = 2.4e-3;  // assumed
  return x;
}

PidGains gains_from_bbmc_units(const AxisConfiguration& axis, double sample_rate_Hz,
                               double proportional, double integral, double derivative) noexcept {
  // % duty per count -> N m per rad.
  const double scale = axis.drive.full_duty_torque_Nm() / 100.0 / axis.rad_per_count();
  return {.proportional_Nm_per_rad = proportional * scale,
          .integral_Nm_per_rad_s = integral * sample_rate_Hz * scale,
          .derivative_Nm_s_per_rad = derivative * scale};
}

}  // namespace towbench::bbmc
