#include "harness/commands/tank_controller.h"

#include <cstdio>

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

std::string unserved_parts_note(const RigFixture& rig) {
  std::string parts;
  const auto add = [&](const char* text, core::Axis axis) {
    parts += fmt::format("{}{} {}", parts.empty() ? "" : ", ", text, core::name_of(axis));
  };
  for (const auto which : core::kAllAxes) {
    const auto& axis = rig.parameters.axes[which];
    if (axis.exists && axis.brake.fitted) {
      add("a holding brake, which stays closed, of", which);
    }
    if (axis.exists && axis.home.fitted) {
      add("a home switch of", which);
    }
  }
  return parts.empty() ? parts
                       : fmt::format(
                             "this controller serves neither home switches nor holding "
                             "brakes, and the machine has {}; a program of your own: "
                             "--controller",
                             parts);
}

void tell_notes(const RigFixture& rig, bool is_bbmc) {
  for (const auto& note :
       {is_bbmc ? tank_controller_note(rig) : std::string(), unserved_parts_note(rig)}) {
    if (!note.empty()) {
      std::fprintf(stderr, "note: %s\n", note.c_str());
    }
  }
}

}  // namespace towbench::harness
