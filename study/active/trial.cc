#include "study/active/trial.h"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <fstream>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "harness/experiment/experiment_toml.h"
#include "harness/fixtures/canonical_hash.h"
#include "harness/fixtures/fixture_error.h"
#include "study/procedures/machine.h"

namespace towbench::study::active {
namespace {

using diagnose::TrialMotion;

constexpr double kLongEnough_s = 24;
constexpr double kWeighing_s = 60;  // of motion
constexpr double kApproachRamp_s = 0.5;
constexpr double kSlack_s = 60;         // of the limits: pauses, settling
constexpr double kPauseOfBbmc_s = 0.5;  // before each motion
constexpr double kEntry_s = 1;          // in which a sine gets going

harness::FixtureError unfit(const std::filesystem::path& folder, const std::string& given,
                            const std::string& allowed) {
  return harness::FixtureError({.file = folder.string()}, given, allowed);
}

harness::ExperimentFixture recorded_in(const std::filesystem::path& folder) {
  std::ifstream stream(folder / "result.json");
  const auto result = nlohmann::json::parse(stream, nullptr, false);
  if (!result.is_object() || result.value("status", "") != "complete") {
    throw unfit(folder, "no complete run of the bench",
                "with --active the first --data is a run folder: its rig, controller and start "
                "are needed to run the next experiment");
  }
  return harness::load_experiment(folder / result["experiment"]["file"].get<std::string>());
}

// The user's rig with the carriage where the recorded run had it must be the recorded machine.
void refuse_another_machine(const harness::ExperimentFixture& recorded,
                            const std::filesystem::path& rig) {
  harness::SourceFiles sources;
  auto parameters = harness::load_rig(rig, sources).parameters;
  for (const auto axis : core::kPlanarAxes) {
    parameters.axes[axis].start_m = recorded.rig.parameters.axes[axis].start_m;
  }
  if (harness::canonical_hash(parameters) != recorded.rig.hash) {
    throw harness::FixtureError({.file = rig.string()},
                                "another machine than the log was recorded on",
                                "the rig of the first run folder");
  }
}

bool starts_with(const std::string& text, const char* what) {
  return text.rfind(what, 0) == 0;
}

// What was typed before the first motion.
std::vector<harness::ConsoleStep> prologue_of(const harness::Experiment& experiment) {
  std::vector<harness::ConsoleStep> steps;
  for (const auto& step : experiment.console) {
    if (step.wait_idle || starts_with(step.send, "run") || starts_with(step.send, "goto")) {
      break;
    }
    steps.push_back(step);
  }
  return steps;
}

std::optional<double> declared_m(const std::vector<harness::ConsoleStep>& prologue,
                                 const std::string& axis) {
  const std::string words = "reset poscalib " + axis + ' ';
  std::optional<double> place;
  for (const auto& step : prologue) {
    if (starts_with(step.send, words.c_str()) && step.send.ends_with("m")) {
      place = std::strtod(step.send.c_str() + words.size(), nullptr);
    }
  }
  return place;
}

harness::ConsoleStep leg(const Site& site, double distance_m, double speed, double ramp_s) {
  return procedures::move(
      fmt::format("run -trapez {} --distance {:.6f}m --speed {:.6f}m/s --acceleration {:.4f}s",
                  site.axis, distance_m, speed, ramp_s),
      std::abs(distance_m) / speed + ramp_s + kSlack_s);
}

// An even number of legs, so that what differs between the directions is there as often.
std::vector<harness::ConsoleStep> to_and_fro(const Site& site, const TrialMotion& m) {
  const double way = 2 * m.amplitude_m;
  const double ramp_s = m.speed_m_per_s / m.acceleration_m_per_s2;
  const double leg_s = way / m.speed_m_per_s + ramp_s + kPauseOfBbmc_s;
  const int pairs = std::max(2, static_cast<int>(std::ceil(kLongEnough_s / (2 * leg_s))));
  std::vector<harness::ConsoleStep> steps;
  for (int pair = 0; pair < pairs; ++pair) {
    steps.push_back(leg(site, way, m.speed_m_per_s, ramp_s));
    steps.push_back(leg(site, -way, m.speed_m_per_s, ramp_s));
  }
  return steps;
}

// From its lower end, begun at a time that is known, so that a push can be timed within it.
std::vector<harness::ConsoleStep> sine(const Site& site, const TrialMotion& m, double at_s,
                                       double duration_s) {
  const double turns = std::ceil(duration_s * m.frequency_Hz);
  auto step = procedures::move(
      fmt::format("run -sinus {} --amplitude {:.6f}m --frequency {:.6f}Hz --turns {:.0f} "
                  "--entry {:.1f}s",
                  site.axis, m.amplitude_m, m.frequency_Hz, turns, kEntry_s),
      turns / m.frequency_Hz + 2 * kEntry_s + kSlack_s);
  step.at_s = at_s;
  return {step};
}

// On for the middle half of the motion: a drift of friction in the course of it cancels.
void time_push(Push& push, double motion_from_s) {
  push.from_s = motion_from_s + 0.25 * kWeighing_s;
  push.to_s = motion_from_s + 0.75 * kWeighing_s;
}

std::vector<emulator::ScheduledEvent> events_of(const Push& push, core::Axis axis) {
  using Kind = emulator::ScheduledEventKind;
  const auto event = [&](double at_s, double force_N) {
    emulator::ScheduledEvent e;
    e.kind = Kind::kPushCarriage;
    e.time_ns = core::nanoseconds(at_s);
    e.axis = axis;
    e.value = force_N;
    return e;
  };
  return {event(push.from_s, push.force_N), event(push.to_s, 0)};
}

harness::Experiment experiment_of(const Site& site, Trial& trial) {
  const TrialMotion& m = trial.motion;
  harness::Experiment e;
  e.name = trial.name;
  e.title = "Separating experiment: " + m.words();
  e.description = "Asked by a diagnosis to tell apart: " + trial.asks + ".";
  e.seed = site.recorded.experiment.seed;
  e.console = site.prologue;
  const double approach_m = m.centre_m - m.amplitude_m - site.start_m;
  const double approach_speed = std::max(m.speed_m_per_s, 0.05);
  double begins_s = 1;
  if (std::abs(approach_m) > 1e-4) {
    e.console.push_back(leg(site, approach_m, approach_speed, kApproachRamp_s));
    begins_s += std::abs(approach_m) / approach_speed + kApproachRamp_s + 2 * kPauseOfBbmc_s + 2;
  }
  const auto motion = m.kind == TrialMotion::Kind::kSine
                          ? sine(site, m, begins_s, trial.push ? kWeighing_s : kLongEnough_s)
                          : to_and_fro(site, m);
  e.console.insert(e.console.end(), motion.begin(), motion.end());
  if (trial.push) {
    time_push(*trial.push, begins_s);
    e.events = events_of(*trial.push, site.axis == "x" ? core::Axis::kX : core::Axis::kY);
  }
  for (const auto& step : e.console) {
    e.duration_limit_s += step.timeout_s;
  }
  e.windows.emplace_back();
  e.budgets.push_back({.metric = "fault_number",
                       .max = 0.0,
                       .source = "a motion inside what the log's own did latches nothing"});
  return e;
}

std::string relative_to(const std::filesystem::path& file, const std::filesystem::path& folder) {
  return std::filesystem::relative(std::filesystem::absolute(file),
                                   std::filesystem::absolute(folder))
      .string();
}

}  // namespace

Site find_site(const std::filesystem::path& run_folder, const std::filesystem::path& rig,
               const std::string& axis) {
  Site site{.recorded = recorded_in(run_folder), .rig_file = rig, .axis = axis};
  if (rig.empty()) {
    site.rig_file = site.recorded.rig_file;
  } else {
    refuse_another_machine(site.recorded, rig);
  }
  if (!site.recorded.experiment.faults.empty() || !site.recorded.experiment.operator_acts.empty()) {
    throw unfit(run_folder, "a run in which something was broken or done by hand",
                "a run of the machine as its rig file has it");
  }
  site.prologue = prologue_of(site.recorded.experiment);
  const auto place = declared_m(site.prologue, axis);
  if (!place) {
    throw unfit(run_folder, "an experiment that does not tell the controller where it stands",
                "\"reset poscalib " + axis + " 0.4m\" before its first motion");
  }
  site.start_m = *place;
  return site;
}

harness::ExperimentFixture write_trial(const Site& site, Trial& trial,
                                       const std::filesystem::path& folder) {
  std::filesystem::create_directories(folder);
  harness::ExperimentFixture fixture = site.recorded;
  fixture.experiment = experiment_of(site, trial);
  const auto path = folder / (trial.name + ".toml");
  std::ofstream file(path);
  file << harness::to_toml(fixture, relative_to(site.rig_file, folder),
                           relative_to(site.recorded.controller_file, folder));
  file.close();
  return harness::load_experiment(path);
}

}  // namespace towbench::study::active
