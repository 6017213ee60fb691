#include <algorithm>

#include "study/prediction/effect.h"

namespace towbench::study::diagnose {

const std::vector<Effect>& effects() {
  static const std::vector<Effect> kAll = [] {
    std::vector<Effect> library;
    add_friction_effects(library);
    add_drive_effects(library);
    add_mechanical_effects(library);
    add_place_effects(library);
    add_periodic_effects(library);
    add_cross_axis_effects(library);
    return library;
  }();
  return kAll;
}

const Effect* find_effect(std::string_view name) {
  const auto found = std::find_if(effects().begin(), effects().end(),
                                  [&](const Effect& e) { return e.name == name; });
  return found == effects().end() ? nullptr : &*found;
}

}  // namespace towbench::study::diagnose
