// The whole machine, one 100 us tick at a time: command paths, supply, the axes, their sensors and
// the kill chain. Knows nothing of messages; plant_node.cc carries its inputs and outputs.
//
// Order of a tick, the same for every carrier and clock: supply voltage and kill chain of the tick
// before -> water at the tick's predicted middle -> command voltages -> the axes -> encoders and
// halls -> supply. Axes meet in the supply, in the water and in `cross_axis_force_ratio` only
// (MACS-A-6); in supply and cross force with one tick of delay.
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <string>

#include "core/axis.h"
#include "core/realtime.h"
#include "core/time.h"
#include "emulator/command_path.h"
#include "emulator/faults/axis_faults.h"
#include "emulator/faults/slipping_disc.h"
#include "emulator/foreign/moved_axis.h"
#include "emulator/holding_brake.h"
#include "emulator/rig_parameters.h"
#include "emulator/sensors/camera.h"
#include "emulator/sensors/current_monitor.h"
#include "emulator/sensors/encoder_wiring.h"
#include "emulator/sensors/force_sensor.h"
#include "emulator/sensors/hall_sensor.h"
#include "emulator/sensors/home_switch.h"
#include "emulator/sensors/input_wiring.h"
#include "emulator/sensors/line_change.h"
#include "emulator/sensors/quadrature_encoder.h"
#include "emulator/supply.h"
#include "emulator/truth_row.h"
#include "emulator/water/water.h"

namespace towbench::emulator {

// One axis with everything that hangs on it.
class RigAxis {
 public:
  struct Seeds {
    std::uint64_t current_monitor = 0;
    std::uint64_t ripple = 0;
  };
  // `at_start`: of a foreign plant, else null.
  RigAxis(core::Axis axis, const RigAxisParameters& parameters, const Seeds& seeds,
          const ForeignOutput* at_start);

  struct Surroundings {
    double supply_V = 0;
    bool amplifier_may_drive = false;  // nor is a brake's coil fed where it may not
    double external_N = 0;
  };
  // The first half of a tick: what reaches the plant.
  TOWBENCH_REALTIME void take_command(const Surroundings& around) noexcept;
  TOWBENCH_REALTIME [[nodiscard]] ForeignInput foreign_input() noexcept {
    return plant_.foreign_input(input_);
  }
  // The second, from `start_ns` on; appends what the switches' lines do. `output` is of a foreign
  // plant.
  TOWBENCH_REALTIME void move(core::Nanoseconds start_ns, const ForeignOutput& output,
                              LineChanges& changes) noexcept;

  CommandPath command;
  bool enable_line = false;
  bool brake_release_line = false;

  [[nodiscard]] EncoderWiring& wiring() noexcept { return wiring_; }
  // Breaks something between connectors and carriage, or puts it right, from the next tick on.
  TOWBENCH_REALTIME void fail(ScheduledEventKind kind, double value) noexcept;
  [[nodiscard]] const MovedAxis& plant() const noexcept { return plant_; }
  [[nodiscard]] const QuadratureEncoder& encoder() const noexcept { return encoder_; }
  // Whether the encoder tells its count besides its edges, and what it tells at the end of the last
  // step.
  [[nodiscard]] bool tells_count() const noexcept { return tells_count_; }
  [[nodiscard]] std::int32_t told_count() const noexcept;
  // Of the last step, as they arrive at the controller.
  [[nodiscard]] const StepEdges& edges() const noexcept { return edges_; }
  // Taken at the end of the last step, if one was due.
  [[nodiscard]] const std::optional<protocol::CurrentSample>& current_sample() const noexcept {
    return current_sample_;
  }
  // At the end of the last step.
  [[nodiscard]] double carriage_m() const noexcept { return state_.carriage_m; }
  // Mean over the last step.
  [[nodiscard]] double carriage_acceleration_m_per_s2() const noexcept {
    return acceleration_m_per_s2_;
  }
  // In the middle of the next step, if the speed changes as in the last one.
  [[nodiscard]] double coming_carriage_speed_m_per_s() const noexcept {
    return state_.carriage_speed_m_per_s + 0.5 * core::kPlantTick_s * acceleration_m_per_s2_;
  }
  // What the amplifier puts into the winding: heat and back EMF. What the inductance borrows it
  // gives back within a millisecond.
  [[nodiscard]] double output_power_W() const noexcept;
  // Of halls and home switch.
  [[nodiscard]] protocol::InputLines switch_lines() const noexcept;
  [[nodiscard]] AxisTruth truth() const noexcept;

 private:
  // What the encoder sees.
  [[nodiscard]] double seen_rad() const noexcept;
  TOWBENCH_REALTIME void turn_shaft() noexcept;
  TOWBENCH_REALTIME void follow_load(const AxisState& before, const AxisState& after) noexcept;

  // Each starts from the state of the one before it.
  MovedAxis plant_;
  AxisState state_;  // the plant's, at the end of the last step
  AxisInput input_;  // of the tick
  QuadratureEncoder encoder_;
  SlippingDisc disc_;
  EncoderWiring wiring_;
  HallSensor hall_min_;
  HallSensor hall_max_;
  std::optional<HomeSwitch> home_;
  std::optional<HoldingBrake> brake_;
  std::optional<CurrentMonitor> current_monitor_;
  std::optional<protocol::CurrentSample> current_sample_;
  MotionSegments segments_;
  StepEdges edges_;
  AxisFaults faults_;
  double resistance_ohm_;
  double torque_constant_Nm_per_A_;
  double motor_rad_per_m_;
  double counts_per_rad_;
  bool sees_load_;    // the encoder
  bool tells_count_;  // likewise
  std::optional<std::int32_t> held_count_;
  // Of an absolute encoder whose A and B are out of place, which its count is not.
  std::optional<EncoderGrating> count_track_;
  double command_V_ = 0.0;
  double skipped_rad_ = 0.0;  // the shaft's angle above that by the transmission
  double acceleration_m_per_s2_ = 0.0;
};

class Rig {
 public:
  // Consistent parameters only (rig_parameters.h). `seed` feeds noise and biases.
  Rig(const RigParameters& parameters, std::uint64_t seed);

  // The axis, or null when the machine has none.
  [[nodiscard]] RigAxis* axis(core::Axis which) noexcept {
    return axes_[which] ? &*axes_[which] : nullptr;
  }
  [[nodiscard]] const RigAxis* axis(core::Axis which) const noexcept {
    return axes_[which] ? &*axes_[which] : nullptr;
  }
  [[nodiscard]] std::uint8_t axes_mask() const noexcept { return axes_mask_; }
  // All axes up to the last one that the machine has.
  [[nodiscard]] std::span<const core::Axis> axes() const noexcept {
    return std::span(core::kAllAxes).first(axis_count_);
  }

  // Inputs of the tick about to run. Times lie inside it, ascending.
  // False, and nothing changed, when the contact bounces more often than one tick can take.
  TOWBENCH_REALTIME [[nodiscard]] bool set_kill_switch(bool pressed,
                                                       core::Nanoseconds time_ns) noexcept;
  TOWBENCH_REALTIME void push_carriage(core::Axis which, double force_N,
                                       core::Nanoseconds time_ns) noexcept;
  TOWBENCH_REALTIME void remove_drive() noexcept;

  TOWBENCH_REALTIME void step() noexcept;

  [[nodiscard]] core::Nanoseconds now_ns() const noexcept { return now_ns_; }
  [[nodiscard]] InputWiring& input_wiring() noexcept { return input_wiring_; }

  // Lines now, as protocol::DigitalInputs, and how they changed in the last tick, oldest first: as
  // they arrive at the controller.
  [[nodiscard]] protocol::InputLines lines() const noexcept { return arriving_lines_; }
  [[nodiscard]] const LineChanges& line_changes() const noexcept { return changes_; }
  [[nodiscard]] const Supply& supply() const noexcept { return supply_; }
  [[nodiscard]] Supply& supply() noexcept { return supply_; }
  // Taken at the end of the last tick, if one was due.
  [[nodiscard]] const std::optional<protocol::ForceSample>& force_sample() const noexcept {
    return force_sample_;
  }
  // Exposed at the end of the last step, if one was due.
  [[nodiscard]] const std::optional<CameraFrame>& camera_frame() const noexcept {
    return camera_frame_;
  }
  // Of the last tick, on the carriage: drag and thrust, without the added mass's inertia.
  [[nodiscard]] const core::PerAxis<double>& water_force_N() const noexcept { return water_N_; }
  [[nodiscard]] TruthRow truth() const noexcept;
  // Of the foreign plant, in one line: from then on the machine stands. Empty: none.
  [[nodiscard]] const std::string& failure() const noexcept {
    static const std::string kNone;
    return foreign_ ? foreign_->failure() : kNone;
  }

 private:
  void make_foreign();
  void step_foreign() noexcept;
  void feel_water() noexcept;
  // Whether axis c turns what hangs in the water (thesis 9.2.1), and by how much.
  [[nodiscard]] bool turns_load() const noexcept;
  [[nodiscard]] PlaneTurn load_turn() const noexcept;
  void measure_force() noexcept;
  void expose_frame() noexcept;
  void update_ready_lines() noexcept;
  [[nodiscard]] double cross_axis_force_N(core::Axis which) const noexcept;

  RigParameters parameters_;
  std::unique_ptr<ForeignPlant> foreign_;  // null: the built-in equations
  core::PerAxis<ForeignOutput> foreign_outputs_;
  core::PerAxis<std::optional<RigAxis>> axes_;
  std::uint8_t axes_mask_ = 0;
  std::size_t axis_count_ = 0;
  Supply supply_;
  std::optional<Water> water_;
  core::PerAxis<double> water_N_{};
  std::optional<ForceSensor> force_sensor_;
  std::optional<protocol::ForceSample> force_sample_;
  std::optional<Camera> camera_;
  std::optional<CameraFrame> camera_frame_;
  core::Nanoseconds now_ns_ = 0;
  InputWiring input_wiring_;
  protocol::InputLines machine_lines_ = 0;
  protocol::InputLines arriving_lines_ = 0;
  LineChanges changes_;
  LineChanges kill_changes_;
  bool kill_pressed_ = false;
  core::PerAxis<double> push_N_{};
  // Change of the push that has not yet acted in the tick that it falls into.
  core::PerAxis<double> push_correction_N_{};
};

}  // namespace towbench::emulator
