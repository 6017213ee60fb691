#include <algorithm>
#include <span>

#include <fmt/format.h>

#include "harness/fault_plan/fault_syntax.h"
#include "harness/fault_plan/fault_text.h"
#include "harness/fixtures/toml_number.h"

namespace towbench::harness {
namespace {

using Trigger = FaultTrigger;

bool read_trigger(TableReader& reader, Trigger& trigger) {
  std::size_t given = 0;
  for (const auto& known : kNumericTriggers) {
    double value = 0;
    reader.value(known.key, value, known.range, "when it begins");
    if (reader.has(known.key)) {
      trigger.kind = known.kind;
      trigger.value = value;
      ++given;
    }
  }
  const auto read_name = [&](const char* key, Trigger::Kind kind,
                             std::span<const std::string_view> names) {
    std::size_t chosen = 0;
    reader.choice(key, chosen, {names.begin(), names.end()});
    if (reader.has(key)) {
      trigger.kind = kind;
      trigger.name = std::string(names[chosen]);
      ++given;
    }
  };
  read_name("phase", Trigger::Kind::kPhase, kPhaseNames);
  read_name("event", Trigger::Kind::kEvent, kEventNames);
  if (given > 1) {
    throw FixtureError(reader.place_of("component"), "several triggers", "one");
  }
  return given == 1;
}

}  // namespace

void check_whole(const Fault& fault, bool has_trigger, const FixtureError::Place& place) {
  const auto& row = fault.row();
  const auto what = fmt::format("{} {}", name_of(fault.place), row.name);
  const bool whole_run = row.start == FaultStart::kWholeRun;
  if (whole_run && (has_trigger || fault.duration_s)) {
    throw FixtureError(place, what + " with a trigger or a duration",
                       "none: the machine is built so");
  }
  if (!whole_run && !has_trigger) {
    throw FixtureError(place, what + " without a trigger",
                       "one of at, position, speed, phase, event");
  }
}

Fault read_fault(TableReader& reader) {
  Fault fault;
  std::string component;
  std::string kind;
  reader.text("component", component, "which part fails");
  reader.text("kind", kind, "how it fails");
  const auto place = place_named(component);
  if (!place) {
    const auto names = all_place_names();
    throw FixtureError(reader.place_of("component"), '"' + component + '"',
                       fmt::format("{}", fmt::join(names, ", ")));
  }
  const auto* row = find_fault(place->part, kind);
  if (row == nullptr) {
    std::vector<std::string_view> kinds;
    for (const auto& known : fault_catalogue()) {
      if (known.part == place->part) {
        kinds.push_back(known.name);
      }
    }
    throw FixtureError(reader.place_of("kind"), '"' + kind + '"',
                       fmt::format("{}", fmt::join(kinds, ", ")));
  }
  fault.place = *place;
  fault.kind = row->kind;
  const bool has_trigger = read_trigger(reader, fault.trigger);
  for (std::size_t i = 0; i < kMostFaultParameters; ++i) {
    const auto& parameter = row->parameters[i];
    fault.parameters[i] = parameter.standard;
    if (!parameter.key.empty()) {
      reader.value(parameter.key, fault.parameters[i], core::between(parameter.min, parameter.max),
                   row->meaning);
    }
  }
  if (fault.kind != FaultKind::kReleased) {
    reader.value("after_s", fault.trigger.after_s, core::between(0, kLongestFaultTime_s),
                 "later than the trigger by so much");
  }
  double duration_s = 0;
  reader.value("duration_s", duration_s, core::between(1e-6, kLongestFaultTime_s),
               "how long it lasts");
  if (reader.has("duration_s")) {
    fault.duration_s = duration_s;
  }
  reader.value("seed", fault.seed, core::between(0, 9e15), "of what the fault draws");
  reader.finish();
  check_whole(fault, has_trigger, reader.place_of("component"));
  return fault;
}

FaultPlan read_fault_plan(const FixtureFile& file) {
  TableReader reader(file, file.table());
  std::string text;
  reader.text("name", text, "short name");
  reader.text("title", text, "one line for a person");
  FaultPlan plan;
  for (auto& table : reader.tables("fault")) {
    plan.push_back(read_fault(table));
  }
  reader.require("fault");
  reader.finish();
  return plan;
}

std::string to_toml(const Fault& fault) {
  const auto& row = fault.row();
  auto text = fmt::format("\n[[fault]]\ncomponent = \"{}\"\nkind = \"{}\"\n", name_of(fault.place),
                          row.name);
  const auto number = [&](std::string_view key, double value) {
    text += fmt::format("{} = {}\n", key, toml_number(value));
  };
  if (row.start == FaultStart::kAnyTime) {
    const bool named =
        fault.trigger.kind == Trigger::Kind::kPhase || fault.trigger.kind == Trigger::Kind::kEvent;
    if (named) {
      text += fmt::format("{} = \"{}\"\n",
                          fault.trigger.kind == Trigger::Kind::kPhase ? "phase" : "event",
                          fault.trigger.name);
    } else {
      number(kNumericTriggers[static_cast<std::size_t>(fault.trigger.kind)].key,
             fault.trigger.value);
    }
    if (fault.trigger.after_s != 0) {
      number("after_s", fault.trigger.after_s);
    }
  }
  if (fault.duration_s) {
    number("duration_s", *fault.duration_s);
  }
  for (std::size_t i = 0; i < kMostFaultParameters; ++i) {
    const auto& parameter = row.parameters[i];
    if (!parameter.key.empty() && fault.parameters[i] != parameter.standard) {
      number(parameter.key, fault.parameters[i]);
    }
  }
  return text + fmt::format("seed = {}\n", fault.seed);
}

}  // namespace towbench::harness
