// One fault of a plan: which part fails, how, when, for how long (docs/theory/safety.md).
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "core/axis.h"
#include "core/time.h"
#include "harness/fault_plan/fault_catalogue.h"
#include "protocol/messages.h"

namespace towbench::harness {

// Where a fault sits: a part of the table, and which one of them.
struct FaultPlace {
  FaultPart part = FaultPart::kKillSwitch;
  core::Axis axis = core::kFirstAxis;  // of end-stop, home switch, encoder, amplifier, drive train
  bool at_max = false;                 // of an end-stop
  bool to_plant = false;               // of a link

  // Of an end-stop or home switch.
  [[nodiscard]] protocol::InputLine switch_line() const noexcept {
    return part == FaultPart::kHomeSwitch ? protocol::home_line(axis)
                                          : protocol::hall_line(axis, at_max);
  }
  friend bool operator==(const FaultPlace&, const FaultPlace&) = default;
};

// "endstop.y_max", "home.y", "kill_switch", "encoder.y", "amplifier.x", "supply", "drive.y",
// "link.to_controller", "link.to_plant", "host". None when it is no place.
[[nodiscard]] std::optional<FaultPlace> place_named(std::string_view name);
[[nodiscard]] std::string name_of(const FaultPlace& place);
[[nodiscard]] std::vector<std::string> all_place_names();

// When it begins. Conditions are found in the fault-free reference run, which is the same run up to
// there.
struct FaultTrigger {
  enum class Kind : std::uint8_t { kTime, kPosition, kSpeed, kPhase, kEvent };
  Kind kind = Kind::kTime;
  double value = 0;    // s; carriage position in m; carriage speed in m/s (magnitude)
  std::string name{};  // of phase or event (motion_phases.h)
  double after_s = 0;  // later by so much
};

inline constexpr std::size_t kMostFaultParameters = 3;

struct Fault {
  FaultPlace place;
  FaultKind kind = FaultKind::kPressed;
  FaultTrigger trigger;
  std::optional<double> duration_s;                       // none: to the end of the run
  std::array<double, kMostFaultParameters> parameters{};  // in the order of the catalogue
  std::uint64_t seed = 1;  // of what the fault draws (times of glitches, lost messages)

  [[nodiscard]] const FaultRow& row() const { return row_of(place.part, kind); }
};

using FaultPlan = std::vector<Fault>;

// As written on the command line: "endstop.y_max stuck_open at=2s". Reads back as the same fault.
[[nodiscard]] std::string describe(const Fault& fault);

}  // namespace towbench::harness
