#include <cmath>
#include <memory>

#include "tests/study/diagnose/foreign/effect.h"

namespace towbench::tests::foreign {
namespace {

Law added_mass(const Hidden& hidden, const Machine& m) {
  return {.added_kg = sized(hidden, 0.15, 0.35) * m.mass_kg};
}

// The compliance grows with the strength: 9 to 16 Hz at full size.
Law chain_elasticity(const Hidden& hidden, const Machine& m) {
  if (!rigid(m)) {
    return {.chain_Hz = m.chain_Hz * std::sqrt(1 - hidden.strength * (0.25 + 0.2 * hidden.draw))};
  }
  return {.chain_Hz = (9 + 7 * hidden.draw) / std::sqrt(hidden.strength)};
}

Law backlash(const Hidden& hidden, const Machine& m) {
  constexpr double kFlank_Hz = 120;  // of both bodies, a flank between them
  return {.chain_Hz = kFlank_Hz, .play_m = sized(hidden, 0.3, 0.7) * m.metres_per_motor_rad};
}

bool has_chain(const Machine& m) {
  return m.sprocket_radius_m > 0;
}
bool has_gear(const Machine& m) {
  return m.metres_per_motor_rad > 0 && m.metres_per_motor_rad < 1 && rigid(m);
}

// No library has these.

// A smooth force of speed and place together.
Law outside_of_place_and_speed(const Hidden& hidden, const Machine& m) {
  const double size_N = sized(hidden, 0.3, 0.6) * m.coulomb_N;
  const double scale = kTurn * (1.5 + hidden.place) / (m.top_speed_m_per_s * m.stroke_m);
  return {.on_load_N = [=](const Now& now) {
    return size_N * std::sin(scale * now.v_m_per_s * (now.x_m - 0.3 * m.stroke_m));
  }};
}

// What a viscoelastic part remembers of half a second (Maxwell).
Law outside_memory(const Hidden& hidden, const Machine& m) {
  constexpr double kMemory_s = 0.5;
  const double rate = sized(hidden, 0.5, 1.0) * m.coulomb_N / (0.25 * m.stroke_m);
  auto stretch = std::make_shared<double>(0);
  return {.memory_N = [=](const Now& now) {
    *stretch += now.h_s * (now.v_m_per_s - *stretch / kMemory_s);
    return -rate * *stretch;
  }};
}

// Friction that is higher after each reversal, until grease has spread over 5 to 15 % of the
// stroke.
Law outside_after_reversal(const Hidden& hidden, const Machine& m) {
  const double more_N = sized(hidden, 0.4, 0.8) * m.coulomb_N;
  const double spreads_m = (0.05 + 0.1 * hidden.place) * m.stroke_m;
  struct Way {
    double m = 0;  // since the last reversal
    double direction = 0;
  };
  auto way = std::make_shared<Way>();
  Law law;
  law.memory_N = [=](const Now& now) {
    const double to = direction(now.v_m_per_s);
    if (to * way->direction < 0) way->m = 0;
    if (to != 0) way->direction = to;
    way->m += now.h_s * std::abs(now.v_m_per_s);
    return 0.0;
  };
  law.dry_N = [=](const Now&) { return more_N * std::exp(-way->m / spreads_m); };
  return law;
}

// 3 % of the drive force: what nobody sees by eye.
Law outside_faint(const Hidden& hidden, const Machine& m) {
  const double size_N =
      0.045 * hidden.strength * (m.coulomb_N + 0.4 * m.inertial_N() + 0.5 * m.gravity_N);
  const double k = kTurn * (1.2 + hidden.place) / m.stroke_m;
  return {.on_load_N = [=](const Now& now) {
    return size_N * std::sin(k * now.x_m) * std::tanh(3 * now.v_m_per_s / m.top_speed_m_per_s) *
           std::cos(2 * now.v_m_per_s / m.top_speed_m_per_s + kTurn * hidden.place);
  }};
}

}  // namespace

std::vector<Effect> body_effects() {
  const std::string family = "body";
  return {
      {"added_mass", family, {"added_mass", "inertia"}, {}, Span::kMass, any_machine, added_mass},
      {"chain_elasticity",
       family,
       {"chain_elasticity"},
       {},
       Span::kNone,
       has_chain,
       chain_elasticity},
      {"backlash", family, {"backlash"}, {}, Span::kNone, has_gear, backlash},
  };
}

std::vector<Effect> outside_effects() {
  const std::string family = "outside";
  // What it has in common with the file's structure moves the parameters.
  const std::vector<std::string> mean{"coulomb", "viscous", "inertia", "bias", "constant_bias"};
  return {
      {"outside_place_and_speed",
       family,
       {},
       mean,
       Span::kNone,
       any_machine,
       outside_of_place_and_speed},
      {"outside_memory", family, {}, mean, Span::kNone, any_machine, outside_memory},
      {"outside_after_reversal",
       family,
       {},
       mean,
       Span::kNone,
       any_machine,
       outside_after_reversal},
      {"outside_faint", family, {}, mean, Span::kNone, any_machine, outside_faint},
  };
}

}  // namespace towbench::tests::foreign
