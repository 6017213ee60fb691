#include "harness/fault_plan/fault.h"

#include <fmt/format.h>

namespace towbench::harness {
namespace {

struct NamedPlace {
  std::string_view name;
  FaultPlace place;
};

constexpr auto kY = core::Axis::kY;
constexpr auto kX = core::Axis::kX;

constexpr std::array<NamedPlace, 15> kPlaces{{
    {"endstop.y_min", {.part = FaultPart::kEndStop, .axis = kY}},
    {"endstop.y_max", {.part = FaultPart::kEndStop, .axis = kY, .at_max = true}},
    {"endstop.x_min", {.part = FaultPart::kEndStop, .axis = kX}},
    {"endstop.x_max", {.part = FaultPart::kEndStop, .axis = kX, .at_max = true}},
    {"kill_switch", {.part = FaultPart::kKillSwitch}},
    {"encoder.y", {.part = FaultPart::kEncoder, .axis = kY}},
    {"encoder.x", {.part = FaultPart::kEncoder, .axis = kX}},
    {"amplifier.y", {.part = FaultPart::kAmplifier, .axis = kY}},
    {"amplifier.x", {.part = FaultPart::kAmplifier, .axis = kX}},
    {"supply", {.part = FaultPart::kSupply}},
    {"drive.y", {.part = FaultPart::kDriveTrain, .axis = kY}},
    {"drive.x", {.part = FaultPart::kDriveTrain, .axis = kX}},
    {"link.to_controller", {.part = FaultPart::kLink}},
    {"link.to_plant", {.part = FaultPart::kLink, .to_plant = true}},
    {"host", {.part = FaultPart::kHost}},
}};

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

protocol::InputLine FaultPlace::hall_line() const noexcept {
  using protocol::InputLine;
  if (axis == core::Axis::kY) {
    return at_max ? InputLine::kHallYMax : InputLine::kHallYMin;
  }
  return at_max ? InputLine::kHallXMax : InputLine::kHallXMin;
}

std::optional<FaultPlace> place_named(std::string_view name) {
  for (const auto& known : kPlaces) {
    if (known.name == name) {
      return known.place;
    }
  }
  return std::nullopt;
}

std::string name_of(const FaultPlace& place) {
  for (const auto& known : kPlaces) {
    if (known.place == place) {
      return std::string(known.name);
    }
  }
  return std::string(name_of(place.part));
}

std::vector<std::string> all_place_names() {
  std::vector<std::string> names;
  for (const auto& known : kPlaces) {
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
