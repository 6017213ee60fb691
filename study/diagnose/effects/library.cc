#include "study/diagnose/effect.h"

namespace towbench::harness::diagnose {

const Library& effect_library() {
  static const Library kLibrary = [] {
    Library library;
    add_friction_effects(library);
    add_low_speed_effects(library);
    add_drive_effects(library);
    add_mechanical_effects(library);
    add_position_effects(library);
    add_periodic_effects(library);
    add_session_effects(library);
    return library;
  }();
  return kLibrary;
}

const Effect* find_effect(std::string_view name) {
  for (const Effect& effect : effect_library()) {
    if (effect.name == name) {
      return &effect;
    }
  }
  return nullptr;
}

}  // namespace towbench::harness::diagnose
