// The tracking experiments of docs/requirements.md (TRK), measured: motor side against the
// controller's own rows, carriage side against what only the emulator knows.
#pragma once

#include <array>
#include <string_view>
#include <vector>

#include "bbmc/system/configuration.h"
#include "core/axis.h"
#include "emulator/rig_parameters.h"

namespace towbench::tests {

// A law by name, made of the tuned plain PID and what is added to it.
struct Law {
  std::string_view name;
  bool feed_forward = false;
  bool friction = false;
  bool observer = false;
  bool cross_coupling = false;
  bool chain = false;  // with S-curve profiles, which it needs
  bool stiff = false;  // the gains of fixtures/controllers/bbmc-stiff.toml
  bool nonlinear_observer = false;
  bool full_state = false;  // the law's speed from the state observer
};

inline constexpr std::array<Law, 8> kLaws{{
    {.name = "PID"},
    {.name = "PID, feed-forward", .feed_forward = true},
    {.name = "PID, feed-forward, friction", .feed_forward = true, .friction = true},
    {.name = "PID, observer", .observer = true},
    {.name = "PID, cross-coupling", .cross_coupling = true},
    {.name = "PID, stiff", .stiff = true},
    {.name = "PID, feed-forward, friction, chain; S-curve",
     .feed_forward = true,
     .friction = true,
     .chain = true},
    // bbmc-best.toml. Cross-coupling would take the chain's lead for an error across the path.
    {.name = "PID, feed-forward, friction, chain, observer; S-curve",
     .feed_forward = true,
     .friction = true,
     .observer = true,
     .chain = true},
}};

// Of thesis 9.3, each beside the law that it is added to.
inline constexpr std::array<Law, 6> kLaws9_3{{
    {.name = "PID"},
    {.name = "PID, nonlinear observer", .nonlinear_observer = true},
    {.name = "PID, friction", .friction = true},
    {.name = "PID, friction, nonlinear observer", .friction = true, .nonlinear_observer = true},
    {.name = "PID, linear observer", .observer = true},
    {.name = "PID, speed of the state observer", .full_state = true},
}};

// The gains of fixtures/controllers/bbmc-tuned.toml and the parts of the law.
[[nodiscard]] bbmc::Configuration tuned(const Law& law);

struct TrapezoidFigures {
  bool sound = false;                      // ran to its end without a fault
  double mean_velocity_error_m_per_s = 0;  // steady state, as Table 7.6
  double mean_error_m = 0;                 // steady state, motor side
  double rms_error_m = 0;                  // steady state, motor side
  double peak_error_m = 0;                 // whole profile, motor side
  double carriage_peak_m = 0;              // whole profile, truth
};

// 0.8 s to speed, 3 s of it, 0.8 s to rest, from y = 0.449 m or x = 0.1 m.
[[nodiscard]] TrapezoidFigures measure_trapezoid(const Law& law, core::Axis axis,
                                                 double speed_m_per_s,
                                                 const emulator::RigParameters& rig = {});

struct CircleFigures {
  bool sound = false;
  core::PerPlanarAxis<double> peak_error_m{};  // motor side
  double path_peak_m = 0;                      // motor side, across the path
  double carriage_path_peak_m = 0;             // truth, across the path
  double carriage_path_rms_m = 0;
};

// Figs 7.14, 7.15: r = 0.20 m, T = 7 s, two turns, one second to speed.
[[nodiscard]] CircleFigures measure_circle(const Law& law);

}  // namespace towbench::tests
