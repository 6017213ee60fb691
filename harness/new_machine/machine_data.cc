#include "harness/new_machine/machine_data.h"

#include <array>

#include "harness/new_machine/derived_machine.h"

namespace towbench::harness {
namespace {

constexpr std::string_view kWheels = "chain belt rack";

constexpr std::array<MachineNumber, static_cast<std::size_t>(Number::kCount)> kNumbers{{
    {"lead-m", core::between(1e-4, 0.2), "way a turn of the screw", {}, "screw"},
    {"radius-m",
     core::between(1e-3, 0.5),
     "pitch radius of sprocket, pulley or pinion",
     {},
     kWheels},
    {"gear-ratio", core::between(0.01, 1000), "motor turns a turn of screw or wheel", 1.0},
    {"mass-kg", core::between(1e-3, 1e4), "all that moves in a line"},
    {"rotor-inertia-kg-m2", core::between(1e-9, 1.0),
     "of motor, coupling, screw or wheel, at the motor"},
    {"torque-constant-Nm-per-A", core::between(1e-4, 100), "of the motor"},
    {"resistance-ohm", core::between(1e-3, 1e3), "of its winding"},
    {"amplifier-gain-A-per-V", core::between(1e-3, 100), "current a volt at the amplifier's input"},
    {"current-limit-A", core::between(0.01, 500), "of amplifier or motor, the smaller"},
    {"supply-V", core::between(1.0, 60.0), "of the amplifier"},
    {"encoder-lines", core::between(1, 10'000), "a motor turn; four counts a line"},
    {"stroke-m", core::between(0.02, 4.0), "from stop to stop"},
    {"friction-N", core::between(0.0, 1e5),
     "that a slow motion takes; unless given 5 % of the drive's force", -1.0},
    {"bandwidth-Hz", core::between(0.5, 20.0), "where the loop's three poles lie", 8.0},
}};

}  // namespace

std::span<const MachineNumber> machine_numbers() noexcept {
  return kNumbers;
}

bool has_number(std::string_view kind, const MachineNumber& number) noexcept {
  return number.of_kinds.empty() || number.of_kinds.find(kind) != std::string_view::npos;
}

double MachineData::operator[](Number which) const {
  const auto index = static_cast<std::size_t>(which);
  return numbers[index].value_or(kNumbers[index].otherwise.value_or(0.0));
}

std::string inconsistency(const MachineData& data) {
  const DerivedMachine machine = derive(data);
  if (machine.friction_N >= 0.5 * machine.force_N) {
    return "friction-N takes more than half of the drive's force";
  }
  if (machine.trial_speed_m_per_s < 1e-3) {
    return "supply-V, current-limit-A or encoder-lines leave less than 1 mm/s to move with";
  }
  return {};
}

}  // namespace towbench::harness
