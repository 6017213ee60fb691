#include "harness/commands/tank_controller.h"

#include <fmt/format.h>

namespace towbench::harness {

std::string tank_controller_note(const RigFixture& rig) {
  std::string others;
  bool turns = false;
  for (const auto axis : core::kAllAxes) {
    const auto* const kind = rig.transmissions[axis];
    if (kind != nullptr && kind != &default_transmission()) {
      others +=
          fmt::format("{}{}: {}", others.empty() ? "" : ", ", core::name_of(axis), kind->name);
      turns = turns || kind->turns_load;
    }
  }
  return others.empty() ? others
                        : fmt::format(
                              "BBMC is the tow tank's controller and takes each axis for one of "
                              "the tank ({}{}); a program of your own: --controller",
                              others, turns ? "; read rad where it says m" : "");
}

}  // namespace towbench::harness
