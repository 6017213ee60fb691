// Sources of sizes: the physical scale of docs/measurements (shares of Coulomb friction), encoder
// data sheets (eccentricity of 0.3 to 1 degree of a turn), chain handbooks (polygon action of
// 1 - cos(pi / z)).
#include <algorithm>
#include <cmath>

#include "tests/study/diagnose/foreign/effect.h"

namespace towbench::tests::foreign {
namespace {

bool has_motor(const Machine& m) {
  return m.metres_per_motor_rad > 0;
}
bool has_sprocket(const Machine& m) {
  return m.sprocket_radius_m > 0 && rigid(m);
}
bool is_joint(const Machine& m) {
  return m.joint();
}

// Two waves over the stroke that no straight line resembles.
Force waves(const Hidden& hidden, const Machine& m) {
  const double k = kTurn / (m.stroke_m * (0.5 + 0.4 * hidden.place));
  const double phase = kTurn * hidden.place;
  return [=](const Now& now) {
    return 0.8 * std::sin(k * now.x_m + phase) + 0.4 * std::sin(1.7 * k * now.x_m - 2 * phase);
  };
}

Law position_force(const Hidden& hidden, const Machine& m) {
  const double size_N = hidden.sign * sized(hidden, 0.25, 0.5) * m.coulomb_N;
  const Force shape = waves(hidden, m);
  return {.on_load_N = [=](const Now& now) { return size_N * shape(now); }};
}

// Over a metre, or over the stroke where that is less.
Law cable_spring(const Hidden& hidden, const Machine& m) {
  const double rate = sized(hidden, 0.25, 0.5) * m.coulomb_N / std::min(1.0, m.stroke_m);
  const double slack_m = m.stroke_m * (0.3 + 0.4 * hidden.place);
  return {.on_load_N = [=](const Now& now) { return -rate * (now.x_m - slack_m); }};
}

Law position_friction(const Hidden& hidden, const Machine& m) {
  const double size_N = sized(hidden, 0.35, 0.7) * m.coulomb_N;
  const Force shape = waves(hidden, m);
  return {.dry_N = [=](const Now& now) { return size_N * shape(now); }};
}

Law position_viscous(const Hidden& hidden, const Machine& m) {
  const double per_speed = sized(hidden, 0.4, 0.8) * m.coulomb_N / m.top_speed_m_per_s;
  const Force shape = waves(hidden, m);
  return {.on_load_N = [=](const Now& now) { return -per_speed * now.v_m_per_s * shape(now); }};
}

Law joint_gravity(const Hidden& hidden, const Machine& /*m*/) {
  return {.gravity_unstated = sized(hidden, 0.4, 1.0)};
}

Force wave(double size_N, double per_metre, double phase) {
  return [=](const Now& now) { return size_N * std::cos(per_metre * now.x_m + phase); };
}

Law torque_ripple(const Hidden& hidden, const Machine& m) {
  const double times = hidden.sign > 0 ? 1 : 2;
  return {.on_motor_N = wave(sized(hidden, 0.15, 0.4) * m.coulomb_N, times / m.metres_per_motor_rad,
                             kTurn * hidden.place)};
}

Law sprocket_ripple(const Hidden& hidden, const Machine& m) {
  return {.on_motor_N = wave(sized(hidden, 0.15, 0.4) * m.coulomb_N, 1 / m.sprocket_radius_m,
                             kTurn * hidden.place)};
}

// A sprocket whose radius is R r(x): the load moves r dx, and what it takes acts with the same r.
Law changing_radius(const Machine& m, double size, double per_metre, double phase) {
  const double load_kg = (1 - m.motor_share) * m.mass_kg;
  const double dry_N = m.load_friction * m.coulomb_N;
  const auto excess = [=](const Now& now) { return size * std::cos(per_metre * now.x_m + phase); };
  Law law;
  law.dry_N = [=](const Now& now) { return excess(now) * dry_N; };
  law.on_motor_N = [=](const Now& now) {
    const double r = 1 + excess(now);
    const double slope = -size * per_metre * std::sin(per_metre * now.x_m + phase);
    return -load_kg * ((r * r - 1) * now.a_m_per_s2 + r * slope * now.v_m_per_s * now.v_m_per_s);
  };
  return law;
}

Law sprocket_eccentricity(const Hidden& hidden, const Machine& m) {
  return changing_radius(m, sized(hidden, 0.06, 0.15), 1 / m.sprocket_radius_m,
                         kTurn * hidden.place);
}

Law chain_polygon(const Hidden& hidden, const Machine& m) {
  const double teeth = m.sprocket_teeth;
  const double size = 0.5 * (1 - std::cos(0.5 * kTurn / teeth)) * sized(hidden, 0.8, 1.5);
  return changing_radius(m, size, teeth / m.sprocket_radius_m, kTurn * hidden.place);
}

Law encoder_eccentricity(const Hidden& hidden, const Machine& m) {
  const double size_m = sized(hidden, 0.005, 0.017) * m.metres_per_motor_rad;
  const double k = 1 / m.metres_per_motor_rad;
  const double phase = kTurn * hidden.place;
  return {.reading_m = [=](double x_m) { return x_m + size_m * std::sin(k * x_m + phase); }};
}

Law encoder_count_loss(const Hidden& hidden, const Machine& /*m*/) {
  const double kept = 1 - sized(hidden, 0.04, 0.08);
  return {.reading_m = [=](double x_m) { return kept * x_m; }};
}

Law periodic_force(const Hidden& hidden, const Machine& m) {
  const double size_N = sized(hidden, 0.15, 0.4) * m.coulomb_N;
  const double pulsation = kTurn * (1.1 + 5 * hidden.place);
  return {.on_load_N = [=](const Now& now) { return size_N * std::sin(pulsation * now.t_s); }};
}

}  // namespace

std::vector<Effect> place_effects() {
  const std::string family = "place";
  const std::string turn = "turn";
  const std::vector<std::string> bias{"bias", "constant_bias", "coulomb_asymmetry"};
  const std::vector<std::string> gravity{"position_force", "gravity", "joint_gravity",
                                         "gravity_of_joint"};
  const std::vector<std::string> sprocket{"sprocket_ripple", "sprocket_eccentricity",
                                          "torque_ripple"};
  return {
      {"position_force",
       family,
       {"position_force"},
       bias,
       Span::kNone,
       any_machine,
       position_force},
      {"cable_spring",
       family,
       {"cable_spring", "position_force"},
       bias,
       Span::kNone,
       any_machine,
       cable_spring},
      {"position_friction",
       family,
       {"position_friction"},
       {"coulomb"},
       Span::kNone,
       any_machine,
       position_friction},
      {"position_viscous",
       family,
       {"position_viscous"},
       {"viscous"},
       Span::kNone,
       any_machine,
       position_viscous},
      {"joint_gravity", family, gravity, bias, Span::kNone, is_joint, joint_gravity},
      {"torque_ripple", turn, {"torque_ripple"}, {}, Span::kNone, has_motor, torque_ripple},
      {"sprocket_ripple", turn, sprocket, {}, Span::kNone, has_sprocket, sprocket_ripple},
      {"sprocket_eccentricity",
       turn,
       {"sprocket_eccentricity"},
       {},
       Span::kNone,
       has_sprocket,
       sprocket_eccentricity},
      {"chain_polygon", turn, {"chain_polygon"}, {}, Span::kNone, has_sprocket, chain_polygon},
      {"encoder_eccentricity",
       turn,
       {"encoder_eccentricity"},
       {},
       Span::kNone,
       has_motor,
       encoder_eccentricity},
      {"encoder_count_loss",
       "session",
       {"encoder_count_loss"},
       {},
       Span::kSeveral,
       rigid,
       encoder_count_loss},
      {"periodic_force",
       "session",
       {"periodic_force"},
       {},
       Span::kNone,
       any_machine,
       periodic_force},
  };
}

}  // namespace towbench::tests::foreign
