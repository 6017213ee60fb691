#include "study/extended_plant/extended_plant.h"

#include <algorithm>

#include <fmt/format.h>

#include "study/extended_plant/plant_text.h"

namespace towbench::study::diagnose {
namespace {

bool any_moved(const Diagnosis& d) {
  return std::any_of(d.parameters.begin(), d.parameters.end(),
                     [](const ParameterShift& shift) { return shift.moved; });
}
bool has_moved(const Diagnosis& d, const char* name) {
  return std::any_of(d.parameters.begin(), d.parameters.end(), [&](const ParameterShift& shift) {
    return shift.moved && shift.name == name;
  });
}

// A constant force beside a cause whose mean is one too: no shift of its own, but part of the fit.
bool has_a_causes_mean(const Diagnosis& d) {
  const bool shared = std::any_of(d.causes.begin(), d.causes.end(), [](const NamedCause& cause) {
    return cause.effect->shares_mean_with == Key::kBias;
  });
  return shared && std::any_of(d.parameters.begin(), d.parameters.end(), [](const auto& shift) {
           const Interval& fitted = shift.fitted;
           return shift.name == "bias" && !shift.moved &&
                  (fitted.low > shift.supplied || fitted.high < shift.supplied);
         });
}

bool write_parameters(PlantText& file, const Parameters& p) {
  const StatedPlant& stated = file.stated();
  const double r = stated.metres_per_motor_rad;
  const FileFriction friction = file_friction(p, stated);
  const double coulomb_Nm = friction.coulomb_N * r;
  const auto with_breakaway = [&](double breakaway_Nm) {
    return file.set(
        {"inertia_kg_m2", "rotor_inertia_kg_m2", "viscous_friction_Nm_s_per_rad",
         "coulomb_friction_Nm", "friction.breakaway_Nm"},
        {std::max(1e-12, p[Key::kMass] - stated.water_kg) * r * r, motor_kg(p, stated) * r * r,
         std::max(0.0, p[Key::kViscous] - stated.water_viscous_N_s_per_m) * r * r, coulomb_Nm,
         breakaway_Nm});
  };
  // An asymmetry that the file states may need more of it than was found.
  const double stated_ratio = stated.breakaway_ratio;
  constexpr double kRounding = 1 + 1e-12;  // never below, whatever the form of the file
  return (with_breakaway((coulomb_Nm + friction.excess_N * r) * kRounding) ||
          with_breakaway(coulomb_Nm * stated_ratio)) &&
         // Another load on the same spring swings otherwise.
         (!stated.model.elastic() || file.set(transmission_keys(), transmission_values(p, stated)));
}

bool write_bias(PlantText& file, const Parameters& p) {
  return file.set({"disturbances.tilt_deg"}, tilt_values(p, file.stated())) ||
         file.set(position_force_keys(), position_force_values(p, file.stated()));
}

bool write_cause(PlantText& file, const Effect& effect, const Parameters& p) {
  return effect.plant_values != nullptr &&
         file.set(effect.plant_keys, effect.plant_values(p, file.stated()));
}

}  // namespace

ExtendedPlant extend_plant(const toml::table& plant, const Diagnosis& d) {
  StatedPlant stated;
  stated.model = d.context.stated;
  stated.stroke_min_m = d.context.stroke_min_m;
  stated.stroke_m = d.context.stroke_m;
  stated.top_speed_m_per_s = d.context.top_speed_m_per_s;
  PlantText file(plant, stated);
  ExtendedPlant out;
  std::string head = "# Written by towbench diagnose: the plant file with what was found.\n";
  const auto leave_out = [&](const std::string& name, const std::string& cause) {
    out.left_out.push_back(name);
    head +=
        fmt::format("# found, but the emulator's plant cannot express it: {} ({})\n", name, cause);
  };
  if (!d.causes.empty() || any_moved(d)) {
    if (!write_parameters(file, d.extended)) leave_out("parameters", "mass and friction");
  }
  if (has_moved(d, "bias") && !write_bias(file, d.extended)) {
    leave_out("constant_bias", "a constant force");
  }
  if (has_a_causes_mean(d)) write_bias(file, d.extended);
  for (const NamedCause& cause : d.causes) {
    if (!write_cause(file, *cause.effect, d.extended)) {
      leave_out(cause.effect->name, cause.effect->cause);
    }
  }
  out.text = head + file.text();
  return out;
}

}  // namespace towbench::study::diagnose
