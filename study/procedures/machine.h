// The machine under test as the procedures of an identification meet it: they can put it somewhere,
// talk to its controller, push it and read what its sensors said. What it truly is they cannot ask.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "harness/fixtures/controller_fixture.h"
#include "harness/fixtures/rig_fixture.h"
#include "harness/lockstep/script_loop.h"
#include "study/identify/recording.h"
#include "study/procedures/run_source.h"

namespace towbench::study::procedures {

// What documents say of an axis: drawings and data sheets. No estimate of them is made.
struct Nameplate {
  bool exists = false;
  double gear_ratio = 0;
  double output_radius_m = 0;
  double counts_per_turn = 0;
  double rotor_inertia_kg_m2 = 0;
  double resistance_ohm = 0;
  double inductance_H = 0;  // winding and choke
  double current_limit_A = 0;
  double current_loop_bandwidth_Hz = 0;
  double pwm_amplitude_V = 0;
  double output_limit_V = 0;  // of the amplifier, at the supply's open-circuit voltage
  bool has_current_monitor = false;

  [[nodiscard]] double metres_per_motor_rad() const noexcept {
    return output_radius_m / gear_ratio;
  }
};

// One conversation with the controller, from power-on.
struct Conversation {
  std::string name;
  core::PerPlanarAxis<double> start_m{};  // where the carriage stands, about
  std::vector<harness::ConsoleStep> steps{};
  std::vector<emulator::ScheduledEvent> events{};  // sorted by time
  double limit_s = 60;
  bool keeps_idle_rows = true;  // false: only rows in which an axis is driven or moves are kept
};

class Machine {
 public:
  // `seed` feeds the sensors' noise and biases, and where exactly the carriage is put: within a
  // millimetre of where it is meant to be, as a hand does it. Without `source` runs are played in
  // memory; it outlives this.
  Machine(harness::RigFixture rig, harness::ControllerFixture controller, std::uint64_t seed,
          harness::LoopWatchers watchers = {}, RunSource* source = nullptr);

  [[nodiscard]] identify::Recording play(const Conversation& conversation) const;
  // The same with other gains, rate or law.
  [[nodiscard]] identify::Recording play(const Conversation& conversation,
                                         const bbmc::Configuration& configuration) const;

  // The same machine under the documents of another one: what they do not tell stays hidden.
  [[nodiscard]] Machine documented_by(const emulator::RigParameters& documents) const;

  // The same with an axis that is known, for what an experiment shows of it. Nothing of what this
  // machine truly is on that axis is in it but its sensors and wires.
  [[nodiscard]] Machine reference(core::Axis axis, const emulator::AxisParameters& known) const;

  [[nodiscard]] const bbmc::Configuration& configuration() const noexcept {
    return controller_.configuration;
  }
  [[nodiscard]] const Nameplate& nameplate(core::Axis axis) const noexcept {
    return nameplates_[axis];
  }
  [[nodiscard]] bool has_force_sensor() const noexcept { return has_force_sensor_; }
  [[nodiscard]] std::uint64_t seed() const noexcept { return seed_; }
  [[nodiscard]] double simulated_s() const noexcept { return simulated_s_; }

 private:
  [[nodiscard]] identify::Recording play_in_memory(const PlannedRun& planned,
                                                   bool keeps_idle_rows) const;

  harness::RigFixture rig_;
  harness::ControllerFixture controller_;
  std::uint64_t seed_;
  harness::LoopWatchers watchers_;
  RunSource* source_;
  core::PerPlanarAxis<Nameplate> nameplates_;
  bool has_force_sensor_;
  mutable double simulated_s_ = 0;
};

// "reset poscalib y 0.449m" and the like: tells the controller where it stands.
[[nodiscard]] std::vector<harness::ConsoleStep> declare_position(const Conversation& conversation,
                                                                 const Machine& machine);
[[nodiscard]] harness::ConsoleStep say(std::string text, std::string expect = "ok");
// A motion: types it and waits until it is over.
[[nodiscard]] harness::ConsoleStep move(std::string text, double timeout_s = 120);

}  // namespace towbench::study::procedures
