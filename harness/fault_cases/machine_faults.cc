#include "harness/fault_cases/machine_faults.h"

#include <algorithm>
#include <array>
#include <cstdlib>
#include <fstream>

#include <fmt/format.h>

#include "harness/fault_cases/fault_case.h"
#include "harness/fixtures/fixture_error.h"
#include "harness/record/event_lines.h"

namespace towbench::harness {
namespace {

void refuse(const Fault& fault, const char* allowed) {
  throw FixtureError({.file = "fault plan"},
                     fmt::format("\"{}\" with a controller that BBMC is not", describe(fault)),
                     allowed);
}

// What the controller's own record tells, beyond positions, speeds and lines of the machine.
bool asks_controller(const FaultTrigger& trigger) {
  return trigger.kind == FaultTrigger::Kind::kPhase ||
         (trigger.kind == FaultTrigger::Kind::kEvent &&
          (trigger.name == "motion" || trigger.name == "motion_end" || trigger.name == "fault"));
}

void add_events(ExperimentFixture& fixture, const std::vector<emulator::ScheduledEvent>& more) {
  auto& events = fixture.experiment.events;
  events.insert(events.end(), more.begin(), more.end());
  std::stable_sort(events.begin(), events.end(),
                   [](const auto& a, const auto& b) { return a.time_ns < b.time_ns; });
}

// Time of the first line in which the files differ, in s; negative when none does.
double first_difference_s(const std::filesystem::path& one, const std::filesystem::path& other) {
  std::ifstream a(one);
  std::ifstream b(other);
  std::string line_a;
  std::string line_b;
  while (true) {
    const bool has_a = static_cast<bool>(std::getline(a, line_a));
    const bool has_b = static_cast<bool>(std::getline(b, line_b));
    if (!has_a && !has_b) {
      return -1;
    }
    if (has_a != has_b || line_a != line_b) {
      return std::strtod((has_a ? line_a : line_b).c_str(), nullptr);
    }
  }
}

std::size_t contacts_in(const std::filesystem::path& folder) {
  std::size_t contacts = 0;
  for (const char* name : {kEventsFile, kPlantEventsFile}) {
    std::ifstream stream(folder / name);
    std::string line;
    while (std::getline(stream, line)) {
      contacts += line.find("\"hard_end_contact\"") != std::string::npos ? 1U : 0U;
    }
  }
  return contacts;
}

}  // namespace

void refuse_faults_beyond_machine(const FaultPlan& faults) {
  for (const Fault& fault : faults) {
    if (fault.place.part == FaultPart::kLink || fault.place.part == FaultPart::kHost) {
      refuse(fault,
             "a fault of the machine: the link and the host of such a controller are its own");
    }
  }
}

PreparedPlan prepare_without_events(const ExperimentFixture& sound, const CaseRecord& reference) {
  for (const Fault& fault : sound.experiment.faults) {
    if (reference.log.empty() && asks_controller(fault.trigger)) {
      refuse(
          fault,
          "a time, a position, a speed or the edge of a line: this controller tells nobody of its "
          "motions and faults");
    }
  }
  return prepare(sound.experiment.faults, sound, reference);
}

ExperimentFixture with_faults(const ExperimentFixture& sound, const PreparedPlan& prepared) {
  auto faulted = sound;
  add_events(faulted, prepared.injection.events);
  faulted.rig.parameters = prepared.built;
  return faulted;
}

std::optional<ExperimentFixture> pressed_where_welded(const ExperimentFixture& sound,
                                                      const PreparedPlan& prepared) {
  std::optional<ExperimentFixture> pressed;
  for (std::size_t i = 0; i < prepared.plan.size(); ++i) {
    if (prepared.plan[i].kind == FaultKind::kWelded) {
      if (!pressed) {
        pressed = sound;
      }
      add_events(*pressed, {{.time_ns = prepared.onsets_ns[i] + kHandComes_ns,
                             .kind = emulator::ScheduledEventKind::kPressKillSwitch}});
    }
  }
  return pressed;
}

std::vector<Check> judge_beside_reference(const std::filesystem::path& folder,
                                          const std::filesystem::path& reference) {
  double fired_s = -1;
  for (const char* name : {"truth.csv", "log.csv"}) {
    const double differs_s = first_difference_s(folder / name, reference / name);
    fired_s = fired_s < 0 ? differs_s : differs_s < 0 ? fired_s : std::min(fired_s, differs_s);
  }
  Check fired;
  fired.name = "fault_fired";
  fired.meaning = "the record differs from the same controller's run without the fault";
  fired.unit = "s";
  fired.verdict = fired_s >= 0 ? Verdict::kPass : Verdict::kInvalid;
  if (fired_s >= 0) {
    fired.value = fired_s;
  } else {
    fired.reason = "no fault of the plan took effect";
  }
  Check contact;
  contact.name = "no_hard_end_contact";
  contact.meaning = "the carriage meets no hard end that it does not meet without the fault";
  const auto contacts = contacts_in(folder);
  const auto before = contacts_in(reference);
  contact.value = static_cast<double>(contacts);
  contact.max = static_cast<double>(before);
  contact.verdict = contacts <= before ? Verdict::kPass : Verdict::kFail;
  contact.reason =
      contacts <= before ? "" : fmt::format("{} contacts, {} without", contacts, before);
  return {fired, contact};
}

}  // namespace towbench::harness
