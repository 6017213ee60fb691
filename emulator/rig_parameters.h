// The whole machine as a parameter set: up to six axes with their sensors and command paths, one
// supply, one kill chain. SI inside; every default has its source in docs/reference/constants.md or
// says "assumed".
//
// An axis may ride on another (`carried_by`): the inertia and friction of the carrier include what
// it carries. In the tow tank X rides on Y (Table 7.4 was identified that way). X's platform moves
// along X only, and the axes are orthogonal, so X's mass loads Y but X's motion does not push Y
// (MACS-A-6); what residual push there is, is `cross_axis_force_ratio`, zero by default. So the
// kinetic energy 1/2 (M_carriage + M_platform) y'^2 + 1/2 M_platform x'^2 has no product x' y' and
// depends on no position, so neither Coriolis nor position terms arise. The water is what couples
// the two: a body moves through it with both velocities (water/water.h).
#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <optional>
#include <string_view>

#include "core/axis.h"
#include "core/parameter.h"
#include "core/time.h"
#include "emulator/foreign/foreign_plant.h"
#include "emulator/plant/axis_parameters.h"
#include "emulator/sensors/sensor_parameters.h"
#include "emulator/water/water_parameters.h"

namespace towbench::emulator {

// PWM ticks -> volts at the amplifier's differential input (5.2).
struct CommandPathParameters {
  double pwm_amplitude_V = 10.0;  // at 100 % duty
  double delay_s = 20e-6;         // assumed; PWM-R-3: below 100 us
  double ripple_rms_V = 0.0;      // what the 100 kHz carrier leaves, at 50 % duty

  template <typename Visitor>
  void visit(Visitor& v) {
    v.value("pwm_amplitude_V", pwm_amplitude_V, core::between(0.1, 50.0),
            "voltage at the amplifier's input at 100 % duty");
    v.value("command_delay_s", delay_s, core::between(0.0, core::kPlantTick_s),
            "from the PWM's output to the amplifier's input");
    v.value("pwm_ripple_rms_V", ripple_rms_V, core::between(0.0, 10.0),
            "noise that the carrier leaves at the amplifier's input, at 50 % duty");
  }
};

// The axis that another one rides on.
enum class Carrier : std::uint8_t { kNone, kY, kX, kZ, kA, kB, kC };

[[nodiscard]] constexpr std::array<std::string_view, 1 + core::kMostAxes> names_of(
    Carrier /*type*/) noexcept {
  return {"none", "y", "x", "z", "a", "b", "c"};
}

[[nodiscard]] constexpr std::optional<core::Axis> axis_of(Carrier carrier) noexcept {
  return carrier == Carrier::kNone
             ? std::nullopt
             : std::optional(core::kAllAxes[static_cast<std::size_t>(carrier) - 1]);
}

// Holding brake of an axis, closed while its coil is not energised. Not fitted unless a rig has its
// table, which says what it holds.
struct BrakeParameters {
  static constexpr std::array<std::string_view, 1> kRequired{"holding_Nm"};
  bool fitted = false;  // no key: its table says so
  double holding_Nm = 0.1;
  double engage_s = 20e-3;   // assumed: data sheets of small spring-applied brakes, 10 to 30 ms
  double release_s = 40e-3;  // assumed: the same, 20 to 60 ms

  template <typename Visitor>
  void visit(Visitor& v) {
    v.value("holding_Nm", holding_Nm, core::above(0.0),
            "torque up to which it holds, at the motor shaft");
    v.value("engage_s", engage_s, core::between(0.0, 10.0), "from the coil's end to its hold");
    v.value("release_s", release_s, core::between(0.0, 10.0), "from the coil's start to no hold");
  }
};

struct RigAxisParameters {
  bool exists = true;
  AxisParameters plant;
  CommandPathParameters command;
  EncoderParameters encoder;
  HallParameters hall_min;
  HallParameters hall_max;
  CurrentMonitorParameters current_monitor;
  HomeParameters home;
  BrakeParameters brake;
  double start_m = 0.0;  // carriage at rest there at time 0, transmission relaxed
  Carrier carried_by = Carrier::kNone;
  double cross_axis_force_ratio = 0.0;
  bool load_turns = false;  // read rad for m; no key: the plant's transmission says so

  template <typename Visitor>
  void visit(Visitor& v) {
    v.value("exists", exists, core::any_finite(), "whether the machine has this axis");
    plant.visit(v);
    command.visit(v);
    v.value("encoder_counts_per_rev", encoder.counts_per_turn, core::between(4, 40'000),
            "counts a motor turn, 4 x the encoder's lines");
    v.value("start_m", start_m, core::between(-1e4, 1e4),
            "carriage position at the start of the run");
    v.value("carried_by", carried_by, core::any_finite(),
            "axis that this one rides on, whose inertia includes what it carries");
    v.value(
        "cross_axis_force_ratio", cross_axis_force_ratio, core::between(-1.0, 1.0),
        "share of the transmission force of carrier and carried axes that pushes along this one");
    v.group("encoder", encoder, "encoder on the motor's shaft or the load");
    v.group("hall_min", hall_min, "end-stop sensor at the min end");
    v.group("hall_max", hall_max, "end-stop sensor at the max end");
    v.group("current_monitor", current_monitor, "the amplifier's current monitor output");
    core::visit_if_fitted(v, "home", home, "switch at a place of the way");
    core::visit_if_fitted(v, "brake", brake, "holding brake");
  }
};

// One 12 V supply feeds both amplifiers (5.2.1).
struct SupplyParameters {
  double voltage_V = 12.0;
  double source_resistance_ohm = 0.02;  // assumed
  double over_current_A = 4.5;          // 5.2.1; trips and stays off
  double over_current_delay_s = 10e-3;  // assumed
  double cut_out_V = 11.4;              // App. A, absolute minimum of the amplifier
  double cut_out_hysteresis_V = 0.2;    // assumed
  double amplifier_efficiency = 0.95;   // App. A

  template <typename Visitor>
  void visit(Visitor& v) {
    v.value("voltage_V", voltage_V, core::between(0.0, 60.0), "open-circuit voltage");
    v.value("source_resistance_ohm", source_resistance_ohm, core::between(0.0, 10.0),
            "of supply and cable: how far the voltage sags");
    v.value("over_current_A", over_current_A, core::above(0.0),
            "current of all axes above which the supply trips");
    v.value("over_current_delay_s", over_current_delay_s, core::between(0.0, 10.0),
            "how long the current may stay above that");
    v.value("cut_out_V", cut_out_V, core::between(0.0, 60.0),
            "voltage below which the amplifiers cut out");
    v.value("cut_out_hysteresis_V", cut_out_hysteresis_V, core::between(0.0, 10.0),
            "how far above that the voltage must come back");
    v.value("amplifier_efficiency", amplifier_efficiency, core::between(0.1, 1.0),
            "power out over power in");
  }
};

struct KillSwitchParameters {
  bool fitted = true;
  bool cuts_amplifiers = false;  // off when the controller's own reaction is under test

  template <typename Visitor>
  void visit(Visitor& v) {
    v.value("fitted", fitted, core::any_finite(), "whether the machine has a kill switch");
    v.value("cuts_amplifiers", cuts_amplifiers, core::any_finite(),
            "whether the contact also cuts the amplifiers in hardware");
  }
};

struct RigAxes : core::PerAxis<RigAxisParameters> {
  template <typename Visitor>
  void visit(Visitor& v) {
    v.group("y", (*this)[core::Axis::kY], "along the tank");
    v.group("x", (*this)[core::Axis::kX], "across the tank");
    for (const core::Axis axis : core::kFurtherAxes) {
      if ((*this)[axis].exists) {
        v.group(core::name_of(axis), (*this)[axis], "an axis of its own");
      }
    }
  }
};

struct RigParameters {
  RigAxes axes;
  SupplyParameters supply;
  KillSwitchParameters kill_switch;
  ForceSensorParameters force_sensor;
  CameraParameters camera;
  WaterParameters water;
  // Of the file this was read from; no parameter. 0 = not known.
  std::uint64_t fixture_hash = 0;
  // Moves the axes in place of the built-in equations; null: these do. No parameter.
  std::shared_ptr<const ForeignPlantSource> foreign_plant;

  // The nominal machine.
  RigParameters() noexcept;

  template <typename Visitor>
  void visit(Visitor& v) {
    v.group("axis", axes, "the axes");
    v.group("supply", supply, "shared 12 V supply");
    v.group("kill_switch", kill_switch, "the operator's kill switch");
    v.group("force_sensor", force_sensor, "six-axis force/torque sensor at the load's mount");
    v.group("camera", camera, "camera above the tank");
    v.group("water", water, "what hangs in the water");
  }
};

[[nodiscard]] bool has_further_axes(const RigParameters& rig) noexcept;

// Whether any axis has an absolute encoder.
[[nodiscard]] bool tells_counts(const RigParameters& rig) noexcept;

// Carriage metres an encoder count, from gear and wheel (3.42).
[[nodiscard]] double metres_per_count(const RigAxisParameters& axis) noexcept;

// What must hold between parameters and no single range can say: the first breach in words that
// name the key, or null. A rig is built from consistent parameters only.
[[nodiscard]] const char* inconsistency(const RigParameters& rig) noexcept;

}  // namespace towbench::emulator
