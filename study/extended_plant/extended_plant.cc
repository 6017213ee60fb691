#include "study/extended_plant/extended_plant.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <sstream>
#include <utility>

#include <fmt/format.h>

#include "harness/files/turning_key.h"

namespace towbench::study::diagnose {
namespace {

constexpr int kKnots = 17;
constexpr double kDegrees = 180 / std::numbers::pi;

// Load side to the side of the file: forces and coefficients times r or r^2.
class Writer {
 public:
  Writer(toml::table& axis, const Diagnosis& d)
      : axis_(axis),
        d_(d),
        motor_side_(axis.contains("inertia_kg_m2")),
        r_(motor_side_ ? d.context.stated.metres_per_motor_rad : 1.0),
        excess_Nm_(d.context.stated.breakaway_excess_N * r_) {}

  void parameters() {
    const Parameters& p = d_.extended;
    const double mass = std::max(1e-12, p[Key::kMass]);
    viscous_ = std::max(0.0, p[Key::kViscous]);
    coulomb_ = std::max(0.0, p[Key::kCoulomb]) * r_;
    axis_.insert_or_assign(motor_side_ ? "inertia_kg_m2" : "mass_kg", mass * r_ * r_);
    axis_.insert_or_assign(
        motor_side_ ? "viscous_friction_Nm_s_per_rad" : "viscous_friction_N_s_per_m",
        viscous_ * r_ * r_);
    set_coulomb(coulomb_);
    keep_stiffness(mass);
  }

  // False when the emulator has no word for the effect.
  bool express(const NamedCause& cause) {
    const std::string& name = cause.effect->name;
    if (name == "amplifier_gain") return gain();
    if (!motor_side_) {
      return false;
    }
    if (name == "position_friction") return position_friction(Key::kPlaceFriction1);
    if (name == "position_force") return position_force(Key::kPlaceForce1);
    if (name == "chain_elasticity") return transmission();
    return friction(name, cause) || disturbance(name);
  }

  // A constant force is a tilt of the rails, which the carriage climbs: b = M g sin(tilt).
  bool tilt(double bias_N) {
    constexpr double kGravity_m_per_s2 = 9.80665;
    const double carriage_kg = d_.extended[Key::kMass] - d_.context.stated.transmission.motor_kg;
    const double sine = bias_N / (std::max(1e-9, carriage_kg) * kGravity_m_per_s2);
    if (!motor_side_ || std::abs(sine) > 0.17) {
      return false;
    }
    table("disturbances").insert_or_assign("tilt_deg", std::asin(sine) * kDegrees);
    return true;
  }

  // Break-away keeps its distance to Coulomb friction, and must not lie below it.
  void keep_consistent() {
    auto* friction = axis_["friction"].as_table();
    if (friction == nullptr || !friction->contains("breakaway_Nm")) {
      return;
    }
    friction->insert_or_assign("breakaway_Nm", coulomb_ + excess_Nm_);
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

  // What adds to friction. The excess over Coulomb friction of a file that states one stays.
  bool friction(const std::string& name, const NamedCause& cause) {
    const double beta = cause.sizes.front().ci95.value;
    if (name == "stribeck") {
      if (d_.context.stated.breakaway_excess_N > 0) {
        return false;  // two of them: the file has one place
      }
      excess_Nm_ = std::max(0.0, beta) * r_;
      table("friction").insert_or_assign("breakaway_Nm", coulomb_ + excess_Nm_);
      table("friction")
          .insert_or_assign("stribeck_speed_rad_per_s", d_.extended[Key::kStribeckSpeed] / r_);
      table("friction").insert_or_assign("stribeck_form", "gaussian");
      return true;
    }
    if (name == "coulomb_asymmetry" && coulomb_ > 0) {
      return share("coulomb", beta * r_ / coulomb_);
    }
    if (name == "viscous_asymmetry" && viscous_ > 0) {
      return share("viscous", beta / viscous_);
    }
    if (name == "load_dependent_friction" && beta <= 0.9) {
      table("friction").insert_or_assign("load_ratio", std::max(0.0, beta));
      return true;
    }
    return false;
  }
  bool share(const char* key, double value) {
    if (std::abs(value) > 0.9) {
      return false;
    }
    auto& friction = table("friction");
    if (friction["asymmetry"].as_table() == nullptr) {
      friction.insert_or_assign("asymmetry", toml::table{});
    }
    friction["asymmetry"].as_table()->insert_or_assign(key, value);
    return true;
  }

  // Forces besides friction, and backlash.
  bool disturbance(const std::string& name) {
    if (name == "cable_spring") return cable();
    if (name == "gravity") return gravity();
    if (name == "torque_ripple") return ripple();
    return name == "backlash" && backlash();
  }
  void disturb(const char* key, toml::table by) {
    table("disturbances").insert_or_assign(key, std::move(by));
  }
  bool cable() {
    const double stiffness = d_.extended[Key::kCable];
    if (stiffness < 0) return false;
    const double middle_m = d_.context.stroke_min_m + 0.5 * d_.context.stroke_m;
    disturb("cable",
            toml::table{{spelt("stiffness_N_per_m"), stiffness}, {spelt("reference_m"), middle_m}});
    return true;
  }
  // The torque against gravity: s sin q + c cos q = m g l sin(q + q0).
  bool gravity() {
    const double sine = d_.extended[Key::kGravitySine];
    const double cosine = d_.extended[Key::kGravityCosine];
    disturb("gravity", toml::table{{"torque_Nm", std::hypot(sine, cosine)},
                                   {"zero_at_deg", std::atan2(cosine, sine) * kDegrees}});
    return true;
  }
  // The fit has the force against the ripple, the file the ripple: -(a cos + b sin) = A sin(k theta
  // + phi).
  bool ripple() {
    if (r_ <= 0) return false;
    const double cosine = -d_.extended[Key::kRippleCosine];
    const double sine = -d_.extended[Key::kRippleSine];
    const double periods = d_.extended[Key::kRipplePerMetre] * 2 * std::numbers::pi * r_;
    disturb("torque_ripple", toml::table{{"amplitude_Nm", std::hypot(cosine, sine) * r_},
                                         {"periods_per_turn", periods},
                                         {"phase_deg", std::atan2(cosine, sine) * kDegrees}});
    return true;
  }
  bool backlash() {
    const double radius_m = d_.context.stated.output_radius_m;
    if (radius_m <= 0) return false;
    table("gear").insert_or_assign("backlash_deg", d_.extended[Key::kPlay] / radius_m * kDegrees);
    return true;
  }

  // The file has the transmission by its free mode and its damping ratio.
  bool transmission() {
    const ElasticTransmission& stated = d_.context.stated.transmission;
    const double stiffness = d_.extended[Key::kStiffness] / stated.stiffness_N_per_m;
    if (!d_.context.stated.elastic() || stiffness < 0.1) {
      return false;
    }
    const double damping = d_.extended[Key::kDamping] / std::max(1e-300, stated.damping_N_s_per_m);
    scale_transmission(std::sqrt(stiffness), std::max(0.0, damping) / std::sqrt(stiffness));
    return true;
  }
  // Another carriage on the same spring swings otherwise.
  void keep_stiffness(double mass_kg) {
    const auto& m = d_.context.stated;
    if (!m.elastic() || !motor_side_) {
      return;
    }
    const auto mobility = [&](double mass) {
      return 1 / m.transmission.motor_kg + 1 / std::max(1e-3, mass - m.transmission.motor_kg);
    };
    const double ratio = std::sqrt(mobility(mass_kg) / mobility(m.mass_kg));
    scale_transmission(ratio, ratio);
  }
  void scale_transmission(double frequency, double damping) {
    scale(table("elasticity"), "resonance_Hz", frequency);
    scale(table("elasticity"), "damping_ratio", damping);
  }
  // A number, or a table that holds it as `value`.
  static void scale(toml::table& in, const char* key, double by) {
    const auto& node = in[key];
    const double given = node.is_table() ? node["value"].value_or(0.0) : node.value_or(0.0);
    in.insert_or_assign(key, given * by);
  }

  bool gain() {
    const char* key = motor_side_ ? "amplifier_gain_A_per_V" : "force_gain_N_per_V";
    if (!axis_.contains(key)) {
      return false;
    }
    scale(axis_, key, 1 - d_.extended[Key::kGainLoss]);
    return true;
  }

  [[nodiscard]] std::string spelt(std::string_view key) const {
    return d_.context.stated.rotary ? harness::turning_key(key) : std::string(key);
  }

  // The force that pushes, as a torque at the motor; its mean is the bias.
  bool position_force(Key first) {
    toml::array at;
    toml::array torque;
    for (const auto& [x_m, force_N] : shape_of(first)) {
      at.push_back(x_m);
      torque.push_back(-force_N * r_);
    }
    disturb("position_force", toml::table{{spelt("position_m"), at}, {"torque_Nm", torque}});
    return true;
  }
  // Knots of sum_k beta_k cos(k pi x), force that the command must make in addition.
  [[nodiscard]] std::vector<std::pair<double, double>> shape_of(Key first) const {
    const Context& c = d_.context;
    std::vector<std::pair<double, double>> knots;
    for (int knot = 0; knot < kKnots; ++knot) {
      const double x = static_cast<double>(knot) / (kKnots - 1);
      double sum = 0;
      for (int k = 0; k < kShapes; ++k) {
        sum += d_.extended[next(first, k)] * std::cos((k + 1) * std::numbers::pi * x);
      }
      knots.emplace_back(c.stroke_min_m + x * c.stroke_m, sum);
    }
    return knots;
  }

  // The table holds added friction, never negative: the shape's least value goes to Coulomb's
  // level.
  bool position_friction(Key first) {
    const auto& m = d_.context.stated;
    const auto stated_Nm = [&](double x_m) { return stated_friction_N(m, x_m) * r_; };
    std::vector<std::pair<double, double>> shape = shape_of(first);
    double least = 0;
    for (auto& [x_m, friction] : shape) {
      friction = friction * r_ + stated_Nm(x_m);
      least = std::min(least, friction);
    }
    toml::array at;
    toml::array friction;
    for (const auto& [x_m, value] : shape) {
      at.push_back(x_m);
      friction.push_back(value - least);
    }
    coulomb_ = std::max(0.0, coulomb_ + least);
    set_coulomb(coulomb_);
    table("friction")
        .insert_or_assign("position",
                          toml::table{{spelt("position_m"), at}, {"friction_Nm", friction}});
    return true;
  }

  toml::table& axis_;
  const Diagnosis& d_;
  bool motor_side_;
  double r_;
  double excess_Nm_;
  double coulomb_ = 0;  // of the file's side
  double viscous_ = 0;  // load side
};

bool something_found(const Diagnosis& d) {
  return !d.causes.empty() || std::any_of(d.parameters.begin(), d.parameters.end(),
                                          [](const ParameterShift& shift) { return shift.moved; });
}

}  // namespace

ExtendedPlant extend_plant(const toml::table& plant, const Diagnosis& d) {
  ExtendedPlant out;
  toml::table extended = plant;
  auto* axis = extended["axis"][d.context.stated.axis].as_table();
  std::string head = "# Written by towbench diagnose: the plant file with what was found.\n";
  if (axis != nullptr) {
    Writer writer(*axis, d);
    if (something_found(d)) {
      writer.parameters();
    }
    for (const ParameterShift& shift : d.parameters) {
      if (shift.name == "bias" && shift.moved && !writer.tilt(shift.fitted.value)) {
        out.left_out.push_back("constant_bias");
        head += "# found, but no key of the plant says it: constant_bias\n";
      }
    }
    for (const NamedCause& cause : d.causes) {
      if (!writer.express(cause)) {
        out.left_out.push_back(cause.effect->name);
        head += fmt::format("# found, but no key of the plant says it: {} ({})\n",
                            cause.effect->name, cause.effect->cause);
      }
    }
    if (something_found(d)) {
      writer.keep_consistent();
    }
  }
  std::ostringstream text;
  text << toml::toml_formatter{
      extended, toml::toml_formatter::default_flags & ~toml::format_flags::allow_literal_strings};
  out.text = head + text.str() + "\n";
  return out;
}

}  // namespace towbench::study::diagnose
