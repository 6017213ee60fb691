// What a person reads behind a number: an axis moves metres, a joint radians.
#pragma once

#include <string_view>

#include "study/prediction/nominal_model.h"

namespace towbench::study::diagnose {

struct Units {
  std::string_view length = "m";
  std::string_view force = "N";
  std::string_view thousandth = "mm";  // of what the position is in
  std::string_view mass = "kg";
  std::string_view viscous = "N s/m";
};

[[nodiscard]] inline Units units_of(const NominalModel& model) {
  return model.rotary ? Units{"rad", "Nm", "mrad", "kg m2", "Nm s/rad"} : Units{};
}

}  // namespace towbench::study::diagnose
