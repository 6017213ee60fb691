#include "harness/fault_plan/fault.h"

#include <fmt/format.h>

namespace towbench::harness {
namespace {

struct NamedPlace {
  std::string name;
  FaultPlace place;
};

void add_of_axes(std::vector<NamedPlace>& places, std::string_view prefix, FaultPart part) {
  for (const auto axis : core::kAllAxes) {
    const auto name = fmt::format("{}.{}", prefix, core::name_of(axis));
    if (part == FaultPart::kEndStop) {
      places.push_back({name + "_min", {.part = part, .axis = axis}});
      places.push_back({name + "_max", {.part = part, .axis = axis, .at_max = true}});
    } else {
      places.push_back({name, {.part = part, .axis = axis}});
    }
  }
}

const std::vector<NamedPlace>& all_places() {
  static const auto kPlaces = [] {
    std::vector<NamedPlace> places;
    add_of_axes(places, "endstop", FaultPart::kEndStop);
    places.push_back({"kill_switch", {.part = FaultPart::kKillSwitch}});
    add_of_axes(places, "encoder", FaultPart::kEncoder);
    add_of_axes(places, "amplifier", FaultPart::kAmplifier);
    places.push_back({"supply", {.part = FaultPart::kSupply}});
    add_of_axes(places, "drive", FaultPart::kDriveTrain);
    add_of_axes(places, "home", FaultPart::kHomeSwitch);
    places.push_back({"link.to_controller", {.part = FaultPart::kLink}});
    places.push_back({"link.to_plant", {.part = FaultPart::kLink, .to_plant = true}});
    places.push_back({"host", {.part = FaultPart::kHost}});
    return places;
  }();
  return kPlaces;
}

std::string trigger_text(const FaultTrigger& trigger) {
  using Kind = FaultTrigger::Kind;
  std::string text;
  switch (trigger.kind) {
    case Kind::kTime:
      text = fmt::format("at_s={}", trigger.value);
      break;
    case Kind::kPosition:
      text = fmt::format("position_m={}", trigger.value);
      break;
    case Kind::kSpeed:
      text = fmt::format("speed_m_per_s={}", trigger.value);
      break;
    case Kind::kPhase:
      text = "phase=" + trigger.name;
      break;
    case Kind::kEvent:
      text = "event=" + trigger.name;
      break;
  }
  return trigger.after_s == 0 ? text : text + fmt::format(" after_s={}", trigger.after_s);
}

}  // namespace

std::optional<FaultPlace> place_named(std::string_view name) {
  for (const auto& known : all_places()) {
    if (known.name == name) {
      return known.place;
    }
  }
  return std::nullopt;
}

std::string name_of(const FaultPlace& place) {
  for (const auto& known : all_places()) {
    if (known.place == place) {
      return std::string(known.name);
    }
  }
  return std::string(name_of(place.part));
}

std::vector<std::string> all_place_names() {
  std::vector<std::string> names;
  for (const auto& known : all_places()) {
    names.emplace_back(known.name);
  }
  return names;
}

std::string describe(const Fault& fault) {
  const auto& row = fault.row();
  auto text = fmt::format("{} {}", name_of(fault.place), row.name);
  if (row.start == FaultStart::kAnyTime) {
    text += ' ' + trigger_text(fault.trigger);
  }
  if (fault.duration_s) {
    text += fmt::format(" duration_s={}", *fault.duration_s);
  }
  for (std::size_t i = 0; i < kMostFaultParameters; ++i) {
    const auto& parameter = row.parameters[i];
    if (!parameter.key.empty() && fault.parameters[i] != parameter.standard) {
      text += fmt::format(" {}={}", parameter.key, fault.parameters[i]);
    }
  }
  return fault.seed == 1 ? text : text + fmt::format(" seed={}", fault.seed);
}

}  // namespace towbench::harness
