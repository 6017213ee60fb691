#include "study/procedures/machine.h"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <numbers>

#include <fmt/format.h>

#include "core/random.h"
#include "harness/link/in_process_plant.h"
#include "harness/link/unrecorded_plant.h"
#include "study/procedures/memory_recorder.h"
#include "study/procedures/recording_frames.h"

namespace towbench::study::procedures {
namespace {

constexpr const char* kSeedOfReference = "twin";  // kept word: another would change the noise

Nameplate nameplate_of(const emulator::RigParameters& rig, core::Axis which) {
  const auto& axis = rig.axes[which];
  const auto& plant = axis.plant;
  return {.exists = axis.exists,
          .gear_ratio = plant.gear_ratio,
          .output_radius_m = plant.output_radius_m,
          .counts_per_turn = static_cast<double>(axis.encoder.counts_per_turn),
          .rotor_inertia_kg_m2 = plant.rotor_inertia_kg_m2,
          .resistance_ohm = plant.winding.resistance_ohm,
          .inductance_H = plant.winding.inductance_H + plant.winding.choke_inductance_H,
          .current_limit_A = plant.current_limit_A,
          .current_loop_bandwidth_Hz = plant.amplifier.current_loop_bandwidth_Hz,
          .pwm_amplitude_V = axis.command.pwm_amplitude_V,
          .output_limit_V = plant.amplifier.output_limit_ratio * rig.supply.voltage_V,
          .has_current_monitor = axis.current_monitor.fitted};
}

// Text decides: two conversations of one session stand in different places and hear other noise.
std::uint64_t seed_of(std::uint64_t session, const std::string& name) {
  std::uint64_t hash = 0xcbf29ce484222325U ^ session;
  for (const char c : name) {
    hash = (hash ^ static_cast<unsigned char>(c)) * 0x100000001b3U;
  }
  return hash;
}

}  // namespace

Machine::Machine(harness::RigFixture rig, harness::ControllerFixture controller, std::uint64_t seed,
                 harness::LoopWatchers watchers, RunSource* source)
    : rig_(std::move(rig)),
      controller_(std::move(controller)),
      seed_(seed),
      watchers_(std::move(watchers)),
      source_(source),
      has_force_sensor_(rig_.parameters.force_sensor.fitted) {
  for (const auto axis : core::kPlanarAxes) {
    nameplates_[axis] = nameplate_of(rig_.parameters, axis);
  }
}

Machine Machine::documented_by(const emulator::RigParameters& documents) const {
  auto machine = *this;
  for (const auto axis : core::kPlanarAxes) {
    machine.nameplates_[axis] = nameplate_of(documents, axis);
  }
  return machine;
}

Machine Machine::reference(core::Axis axis, const emulator::AxisParameters& known) const {
  auto rig = rig_;
  rig.parameters.axes[axis].plant = known;
  return {std::move(rig), controller_, seed_of(seed_, kSeedOfReference), watchers_, source_};
}

identify::Recording Machine::play(const Conversation& conversation) const {
  return play(conversation, controller_.configuration);
}

identify::Recording Machine::play(const Conversation& conversation,
                                  const bbmc::Configuration& configuration) const {
  constexpr double kHandIsOff_m = 1e-3;
  const auto seed = seed_of(seed_, conversation.name);
  core::Random random(seed);
  auto rig = rig_;
  for (const auto axis : core::kPlanarAxes) {
    const double off_m = kHandIsOff_m * (2 * random.uniform() - 1);
    if (rig.parameters.axes[axis].exists) {
      rig.parameters.axes[axis].start_m = conversation.start_m[axis] + off_m;
    }
  }
  harness::Experiment experiment;
  experiment.name = conversation.name;
  experiment.duration_limit_s = conversation.limit_s;
  experiment.console = conversation.steps;
  experiment.events = conversation.events;

  auto controller = controller_;
  controller.configuration = configuration;
  const PlannedRun planned{rig, controller, experiment, seed};
  auto recording = source_ != nullptr ? source_->run(planned)
                                      : play_in_memory(planned, conversation.keeps_idle_rows);
  if (source_ != nullptr && recording.rows() > 0) {
    simulated_s_ += recording.time_s.back();
  }
  if (recording.period_s == 0) {
    recording.period_s = core::seconds(configuration.control_period_ns());
  }
  for (const auto axis : core::kPlanarAxes) {
    recording.rad_per_count[axis] = 2 * std::numbers::pi / nameplates_[axis].counts_per_turn;
    recording.metres_per_count[axis] =
        recording.rad_per_count[axis] * nameplates_[axis].metres_per_motor_rad();
  }
  return recording;
}

identify::Recording Machine::play_in_memory(const PlannedRun& planned, bool keeps_idle_rows) const {
  harness::UnrecordedPlant nobody;
  harness::InProcessPlant plant(planned.rig.parameters, planned.seed, planned.experiment.events,
                                nobody);
  MemoryRecorder recorder(keeps_idle_rows);
  SensorTap tapped(plant, recorder);
  harness::LockstepBench bench(planned.controller.configuration, planned.rig.hash, tapped,
                               &recorder);
  const auto outcome = harness::play(planned.experiment, bench, recorder, watchers_);
  auto recording = recorder.take();
  simulated_s_ += core::seconds(outcome.end_ns);
  drop_other_frames(recording);
  if (!recording.trouble.empty()) {
    // the fault that was latched says more than how the script ended
  } else if (!outcome.complete) {
    recording.trouble = outcome.reason;
  } else if (!outcome.script_failure.empty()) {
    recording.trouble = outcome.script_failure;
  } else if (outcome.rows_lost > 0) {
    recording.trouble = fmt::format("{} rows of the log were lost", outcome.rows_lost);
  }
  return recording;
}

harness::ConsoleStep say(std::string text, std::string expect) {
  harness::ConsoleStep step;
  step.send = std::move(text);
  step.expect = std::move(expect);
  return step;
}

harness::ConsoleStep move(std::string text, double timeout_s) {
  harness::ConsoleStep step;
  step.send = std::move(text);
  step.expect = "done";
  step.wait_idle = true;
  step.timeout_s = timeout_s;
  return step;
}

std::vector<harness::ConsoleStep> declare_position(const Conversation& conversation,
                                                   const Machine& machine) {
  std::vector<harness::ConsoleStep> steps;
  for (const auto axis : core::kPlanarAxes) {
    if (machine.nameplate(axis).exists) {
      steps.push_back(say(fmt::format("reset poscalib {} {:.6f}m", core::name_of(axis),
                                      conversation.start_m[axis])));
    }
  }
  return steps;
}

}  // namespace towbench::study::procedures
