#include "harness/experiment/event_text.h"

#include <algorithm>
#include <array>
#include <string_view>

#include <fmt/format.h>

#include "core/time.h"
#include "harness/experiment/reference.h"
#include "harness/fixtures/toml_number.h"

namespace towbench::harness {
namespace {

using EventKind = emulator::ScheduledEventKind;

constexpr std::array kEventKinds{EventKind::kPressKillSwitch, EventKind::kReleaseKillSwitch,
                                 EventKind::kPushCarriage, EventKind::kReset};
constexpr std::array<std::string_view, kEventKinds.size()> kEventNames{
    "press_kill_switch", "release_kill_switch", "push_carriage", "reset"};

emulator::ScheduledEvent read_event(TableReader& reader, bool takes_reset) {
  double at_s = 0;
  reader.value("at_s", at_s, core::between(0, kLongestRun_s), "when it happens");
  std::size_t kind = 0;
  reader.choice("do", kind, {kEventNames.begin(), kEventNames.end()});
  std::size_t axis = 0;
  reader.choice("axis", axis, {core::kAxisNames.begin(), core::kAxisNames.end()});
  emulator::ScheduledEvent event;
  reader.value("force_N", event.value, core::between(-1000, 1000), "push from then on");
  reader.require("at_s");
  reader.require("do");
  event.kind = kEventKinds.at(kind);
  if (event.kind == EventKind::kPushCarriage) {
    reader.require("axis");
    reader.require("force_N");
  } else if (reader.has("axis") || reader.has("force_N")) {
    const char* const key = reader.has("axis") ? "axis" : "force_N";
    throw FixtureError(reader.place_of(key), "a key without effect", "only with push_carriage");
  }
  reader.finish();
  if (event.kind == EventKind::kReset && !takes_reset) {
    throw FixtureError(reader.place_of("do"), "\"reset\" without [[reference]]",
                       "a [[console]] step that sends `reset`");
  }
  event.time_ns = core::nanoseconds(at_s);
  event.axis = static_cast<core::Axis>(axis);
  return event;
}

}  // namespace

std::vector<emulator::ScheduledEvent> read_events(TableReader& experiment, bool takes_reset) {
  std::vector<emulator::ScheduledEvent> events;
  for (auto& reader : experiment.tables("event")) {
    events.push_back(read_event(reader, takes_reset));
  }
  std::stable_sort(events.begin(), events.end(),
                   [](const auto& a, const auto& b) { return a.time_ns < b.time_ns; });
  return events;
}

std::string to_toml(const emulator::ScheduledEvent& event) {
  const auto* const kind = std::find(kEventKinds.begin(), kEventKinds.end(), event.kind);
  auto text = fmt::format("\n[[event]]\nat_s = {}\ndo = \"{}\"\n",
                          toml_number(core::seconds(event.time_ns)),
                          kEventNames.at(static_cast<std::size_t>(kind - kEventKinds.begin())));
  if (event.kind == EventKind::kPushCarriage) {
    text += fmt::format("axis = \"{}\"\nforce_N = {}\n", core::name_of(event.axis),
                        toml_number(event.value));
  }
  return text;
}

}  // namespace towbench::harness
