#include "harness/fault_cases/machine_faults.h"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <fstream>
#include <span>

#include <fmt/format.h>

#include "harness/fault_cases/fault_case.h"
#include "harness/fault_cases/motion_phases.h"
#include "harness/files/csv_table.h"
#include "harness/fixtures/fixture_error.h"
#include "harness/record/event_lines.h"

namespace towbench::harness {
namespace {

void refuse(const Fault& fault, const char* allowed) {
  throw FixtureError({.file = "fault plan"},
                     fmt::format("\"{}\" with a controller that BBMC is not", describe(fault)),
                     allowed);
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

Check fault_fired(const std::string& name, const std::string& fault,
                  const std::filesystem::path& folder, const std::filesystem::path& without) {
  double fired_s = -1;
  for (const char* file : {"truth.csv", "log.csv"}) {
    const double differs_s = first_difference_s(folder / file, without / file);
    fired_s = fired_s < 0 ? differs_s : differs_s < 0 ? fired_s : std::min(fired_s, differs_s);
  }
  Check fired;
  fired.name = name;
  fired.meaning = "the record differs from the same controller's run without the fault";
  fired.unit = "s";
  fired.verdict = fired_s >= 0 ? Verdict::kPass : Verdict::kInvalid;
  if (fired_s >= 0) {
    fired.value = fired_s;
  } else {
    fired.reason = fault + " took no effect";
  }
  return fired;
}

std::vector<Check> each_fired(const std::filesystem::path& folder,
                              const std::filesystem::path& reference,
                              const std::vector<RunWithout>& without) {
  if (without.empty()) {
    return {fault_fired("fault_fired", "the fault of the plan", folder, reference)};
  }
  std::vector<Check> fired;
  for (const auto& [fault, run] : without) {
    fired.push_back(fault_fired(fmt::format("fault_{}_fired", fired.size() + 1),
                                fmt::format("\"{}\"", fault), folder, run->files.path()));
  }
  return fired;
}

Check no_further_contact(const std::filesystem::path& folder,
                         const std::filesystem::path& reference) {
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
  return contact;
}

// The longest time for which an axis is driven with nearly all there is.
double longest_at_limit_s(const std::filesystem::path& folder) {
  constexpr double kNearlyAll_pct = 95;
  const auto log = CsvTable::load(folder / "log.csv");
  const auto time_s = log.column("time_s");
  double longest_s = 0;
  for (const auto axis : core::kAllAxes) {
    const auto duty_pct = log.column(fmt::format("{}_duty_pct", core::name_of(axis)));
    double since_s = -1;
    for (std::size_t i = 0; i < duty_pct.size(); ++i) {
      if (std::fabs(duty_pct[i]) < kNearlyAll_pct) {
        since_s = -1;
      } else if (since_s < 0) {
        since_s = time_s[i];
      }
      longest_s = std::max(longest_s, since_s < 0 ? 0.0 : time_s[i] - since_s);
    }
  }
  return longest_s;
}

bool changes(std::span<const double> column) {
  return std::any_of(column.begin(), column.end(), [&](double each) {
    return std::fabs(each - column.front()) > 0;  // false where either is no number
  });
}

// A controller that does nothing withstands everything, and shows nothing.
Check reference_moves(const std::filesystem::path& reference) {
  bool moves = false;
  std::string trouble = "without the fault nothing is driven and counted";
  try {
    const auto log = CsvTable::load(reference / "log.csv");
    for (const auto axis : core::kAllAxes) {
      moves = moves || (changes(log.column(fmt::format("{}_duty_pct", core::name_of(axis)))) &&
                        changes(log.column(fmt::format("{}_count", core::name_of(axis)))));
    }
  } catch (const CsvError& error) {
    trouble = error.what();
  }
  auto check = invalid_check("reference_moves", "without the fault an axis is driven and moves",
                             moves ? "" : trouble);
  check.verdict = moves ? Verdict::kPass : Verdict::kInvalid;
  return check;
}

Check no_longer_at_limit(const std::filesystem::path& folder,
                         const std::filesystem::path& reference) {
  constexpr double kLonger_s = 0.3;
  Check check;
  check.name = "no_sustained_full_duty";
  check.meaning = "no axis is driven with 95 % or more for 0.3 s longer than without the fault";
  check.source = "ANY-8";
  check.unit = "s";
  try {
    check.value = longest_at_limit_s(folder);
    check.max = longest_at_limit_s(reference) + kLonger_s;
    const bool longer = *check.value > *check.max;
    check.verdict = longer ? Verdict::kFail : Verdict::kPass;
    check.reason = longer ? fmt::format("driven so for {:.3f} s in a row", *check.value) : "";
  } catch (const CsvError& error) {
    check.verdict = Verdict::kInvalid;
    check.reason = error.what();
  }
  return check;
}

}  // namespace

bool is_within(const Fault& fault, FaultReach reach) {
  if (fault.place.part == FaultPart::kLink) {
    return reach == FaultReach::kMachineAndLink && !may_end_run(fault.kind);
  }
  return fault.place.part != FaultPart::kHost;
}

void refuse_faults_beyond(const FaultPlan& faults, FaultReach reach) {
  for (const Fault& fault : faults) {
    if (!is_within(fault, reach)) {
      refuse(fault, reach == FaultReach::kMachine
                        ? "a fault of the machine: an image has no link, and its host is its own"
                        : "a fault of the machine or of what crosses the link: such a "
                          "controller's host is its own, and without a link there is no run");
    }
  }
}

PreparedPlan prepare_without_bbmc(const ExperimentFixture& sound, const CaseRecord& reference) {
  for (const Fault& fault : sound.experiment.faults) {
    const bool asks_controller =
        fault.trigger.kind == FaultTrigger::Kind::kEvent && fault.trigger.name == "fault";
    if (asks_controller && !tells_of_itself(reference)) {
      refuse(fault, "another moment: this controller tells nobody of the faults that it finds");
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
      add_events(*pressed, {{.time_ns = prepared.onsets_ns[i] + kOperatorReaction_ns,
                             .kind = emulator::ScheduledEventKind::kPressKillSwitch}});
    }
  }
  return pressed;
}

std::vector<LeftOut> each_left_out(const ExperimentFixture& sound, const PreparedPlan& prepared,
                                   const CaseRecord& reference) {
  std::vector<LeftOut> all;
  const auto count = std::ssize(prepared.plan);
  for (std::ptrdiff_t i = 0; count > 1 && i < count; ++i) {
    auto plan = prepared.plan;
    auto onsets_ns = prepared.onsets_ns;
    const PreparedPlan alone{.plan = {plan[static_cast<std::size_t>(i)]},
                             .onsets_ns = {onsets_ns[static_cast<std::size_t>(i)]}};
    plan.erase(plan.begin() + i);
    onsets_ns.erase(onsets_ns.begin() + i);
    const auto others = prepare_at(plan, onsets_ns, sound, reference, prepared.injection.over_can);
    const auto base = pressed_where_welded(sound, alone).value_or(sound);
    all.push_back({describe(alone.plan[0]), with_faults(base, others), others.injection.link});
  }
  return all;
}

std::vector<Check> judge_beside_reference(const std::filesystem::path& folder,
                                          const std::filesystem::path& reference,
                                          const std::vector<RunWithout>& without) {
  auto checks = each_fired(folder, reference, without);
  checks.push_back(reference_moves(reference));
  checks.push_back(no_further_contact(folder, reference));
  checks.push_back(no_longer_at_limit(folder, reference));
  return checks;
}

}  // namespace towbench::harness
