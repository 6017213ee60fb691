// What is asked of the controller, by the number of the exchange: the same whether the machine is
// there or only its recorded messages are.
#pragma once

#include "bbmc/system/system_manager.h"
#include "bbmc/system/trajectory/harmonic.h"
#include "bbmc/system/trajectory/pulse_program.h"
#include "bbmc/system/trajectory/s_curve.h"

namespace towbench::portable {

inline constexpr long kExchanges = 14'000;  // of 1 ms
inline constexpr core::PerPlanarAxis<double> kStart_m{{1.0, 0.3}};

// Every part of the law, so that every line of it is compared.
inline bbmc::Configuration configuration() {
  bbmc::Configuration all;
  for (auto& axis : all.axes) {
    axis.feed_forward.enabled = true;
    axis.friction.enabled = true;
    axis.disturbance_observer.enabled = true;
    axis.chain.enabled = true;
  }
  all.axes[core::Axis::kY].gains = {.proportional_Nm_per_rad = 0.05,
                                    .integral_Nm_per_rad_s = 0.5,
                                    .derivative_Nm_s_per_rad = 6e-4};
  all.axes[core::Axis::kX].gains = {.proportional_Nm_per_rad = 0.02,
                                    .integral_Nm_per_rad_s = 0.2,
                                    .derivative_Nm_s_per_rad = 2e-4};
  all.cross_coupling.enabled = true;
  return all;
}

// A trapezoid, a circle, a goto, pulses in open loop and a stop on the way. False: refused.
inline bool ask(bbmc::SystemManager& system, long exchange) {
  using core::Axis;
  const auto at = [&](Axis axis) { return system.status().axes[axis].position_m; };
  bbmc::MotionRequest request;
  request.driven = {{true, true}};
  switch (exchange) {
    case 10:
      return system.calibrate_position(Axis::kY, 445'348).has_value() &&
             system.calibrate_position(Axis::kX, 222'674).has_value();
    case 20: {
      request.trajectory[Axis::kY] = bbmc::SCurve::make({.start_m = at(Axis::kY),
                                                         .distance_m = 0.5,
                                                         .speed_m_per_s = 0.3,
                                                         .acceleration_time_s = 0.3,
                                                         .deceleration_time_s = 0.3,
                                                         .wait_s = 0.05},
                                                        0.24)
                                         .value();
      request.trajectory[Axis::kX] = bbmc::Hold(at(Axis::kX));
      return system.request_motion(request).has_value();
    }
    case 3'500: {
      const bbmc::PhaseRampParameters phase{.frequency_hz = 0.4, .turns = 1, .ramp_s = 0.5};
      request.trajectory[Axis::kY] =
          bbmc::Harmonic::make({.start_m = at(Axis::kY), .amplitude_m = 0.1, .phase = phase})
              .value();
      request.trajectory[Axis::kX] = bbmc::Harmonic::make({.start_m = at(Axis::kX),
                                                           .amplitude_m = 0.1,
                                                           .starting_phase_turns = 0.25,
                                                           .phase = phase})
                                         .value();
      return system.request_motion(request).has_value();
    }
    case 8'000:
      return system.request_goto({.target_m = {{1.3, 0.35}}, .fast = true}).has_value();
    case 8'900:
      return system.stop().has_value();
    case 10'000: {
      bbmc::OpenLoopRequest open_loop;
      open_loop.driven[Axis::kY] = true;
      open_loop.program[Axis::kY] =
          bbmc::PulseProgram::make(
              {.duty_pct = 9, .on_s = 0.2, .off_s = 0.3, .pulses = 4, .alternate = true})
              .value();
      return system.request_open_loop(open_loop).has_value();
    }
    default:
      return true;
  }
}

}  // namespace towbench::portable
