#include "harness/diagnose/extended_plant.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <sstream>

#include <fmt/format.h>

namespace towbench::harness::diagnose {
namespace {

constexpr int kKnots = 17;

// Load side to the side of the file: forces and coefficients times r or r^2.
class Writer {
 public:
  Writer(toml::table& axis, const Diagnosis& d)
      : axis_(axis),
        d_(d),
        motor_side_(axis.contains("inertia_kg_m2")),
        r_(motor_side_ ? d.context.model.metres_per_motor_rad : 1.0) {}

  void parameters() {
    const Theta theta = d_.selection.after.theta();
    const double mass = std::max(1e-12, theta[kMass]);
    const double viscous = std::max(0.0, theta[kViscous]);
    coulomb_ = std::max(0.0, theta[kCoulomb]) * r_;
    axis_.insert_or_assign(motor_side_ ? "inertia_kg_m2" : "mass_kg", mass * r_ * r_);
    axis_.insert_or_assign(
        motor_side_ ? "viscous_friction_Nm_s_per_rad" : "viscous_friction_N_s_per_m",
        viscous * r_ * r_);
    set_coulomb(coulomb_);
  }

  // False when the emulator has no word for the effect.
  bool express(const Cause& cause) {
    const std::string& name = cause.term.effect->name;
    if (name == "stribeck" && motor_side_) {
      auto& friction = table("friction");
      friction.insert_or_assign("breakaway_Nm", coulomb_ + std::max(0.0, cause.beta[0]) * r_);
      friction.insert_or_assign("stribeck_speed_rad_per_s", cause.term.scales[0] / r_);
      friction.insert_or_assign("stribeck_form", "gaussian");
      return true;
    }
    return name == "position_friction" && motor_side_ && position_friction(cause);
  }

  // Break-away must not lie below Coulomb friction.
  void keep_consistent() {
    auto* friction = axis_["friction"].as_table();
    if (friction == nullptr || !friction->contains("breakaway_Nm")) {
      return;
    }
    const auto& node = (*friction)["breakaway_Nm"];
    const double given = node.is_table() ? node["value"].value_or(0.0) : node.value_or(0.0);
    if (given < coulomb_) {
      friction->insert_or_assign("breakaway_Nm", coulomb_);
    }
  }

 private:
  void set_coulomb(double value) {
    axis_.insert_or_assign(motor_side_ ? "coulomb_friction_Nm" : "coulomb_friction_N", value);
  }
  toml::table& table(const char* key) {
    if (axis_[key].as_table() == nullptr) {
      axis_.insert_or_assign(key, toml::table{});
    }
    return *axis_[key].as_table();
  }

  // The table holds added friction, never negative: the shape's least value goes to Coulomb's
  // level.
  bool position_friction(const Cause& cause) {
    const Context& c = d_.context;
    if (!c.model.friction_at_m.empty()) {
      return false;  // it would have to be added to the table that is there
    }
    std::vector<double> shape;
    double least = 0;
    for (int knot = 0; knot < kKnots; ++knot) {
      const double x = static_cast<double>(knot) / (kKnots - 1);
      double sum = 0;
      for (Eigen::Index k = 0; k < cause.beta.size(); ++k) {
        sum += cause.beta[k] * std::cos(static_cast<double>(k + 1) * std::numbers::pi * x);
      }
      shape.push_back(sum * r_);
      least = std::min(least, shape.back());
    }
    toml::array at;
    toml::array friction;
    for (int knot = 0; knot < kKnots; ++knot) {
      const double x = static_cast<double>(knot) / (kKnots - 1);
      at.push_back(c.stroke_min_m + x * (c.stroke_max_m - c.stroke_min_m));
      friction.push_back(shape[static_cast<std::size_t>(knot)] - least);
    }
    coulomb_ = std::max(0.0, coulomb_ + least);
    set_coulomb(coulomb_);
    table("friction")
        .insert_or_assign("position", toml::table{{"position_m", at}, {"friction_Nm", friction}});
    return true;
  }

  toml::table& axis_;
  const Diagnosis& d_;
  bool motor_side_;
  double r_;
  double coulomb_ = 0;
};

}  // namespace

ExtendedPlant extend_plant(const toml::table& plant, const Diagnosis& d) {
  ExtendedPlant out;
  toml::table extended = plant;
  auto* axis = extended["axis"][d.context.model.axis].as_table();
  std::string head = "# Written by towbench diagnose: the plant file with what was found.\n";
  if (axis != nullptr) {
    Writer writer(*axis, d);
    writer.parameters();
    for (const Cause& cause : d.selection.causes) {
      if (!writer.express(cause)) {
        out.left_out.push_back(cause.term.effect->name);
        head += fmt::format("# found, but no key of the plant says it: {} ({})\n",
                            cause.term.effect->name, cause.term.effect->cause);
      }
    }
    writer.keep_consistent();
  }
  std::ostringstream text;
  text << toml::toml_formatter{
      extended, toml::toml_formatter::default_flags & ~toml::format_flags::allow_literal_strings};
  out.text = head + text.str() + "\n";
  return out;
}

}  // namespace towbench::harness::diagnose
