// Sources of sizes: Armstrong-Helouvry, Dupont, Canudas de Wit 1994, Automatica 30 (Stribeck,
// break-away, presliding); Dahl 1968; gear catalogues (load-dependent loss of 8 to 20 %).
#include <cmath>
#include <memory>

#include "tests/study/diagnose/foreign/effect.h"

namespace towbench::tests::foreign {
namespace {

Law coulomb(const Hidden& hidden, const Machine& m) {
  return {.coulomb_N = hidden.sign * sized(hidden, 0.25, 0.45) * m.coulomb_N};
}

Law viscous(const Hidden& hidden, const Machine& m) {
  return {.viscous_N_s_per_m = hidden.sign * sized(hidden, 0.4, 0.8) * m.viscous_N_s_per_m};
}

Law coulomb_asymmetry(const Hidden& hidden, const Machine& m) {
  const double more_N = hidden.sign * sized(hidden, 0.15, 0.35) * m.coulomb_N;
  return {.dry_N = [=](const Now& now) { return now.v_m_per_s >= 0 ? more_N : -more_N; }};
}

Law viscous_asymmetry(const Hidden& hidden, const Machine& m) {
  const double per_speed =
      hidden.sign * sized(hidden, 0.3, 0.6) * m.coulomb_N / m.top_speed_m_per_s;
  return {.on_load_N = [=](const Now& now) { return -per_speed * std::abs(now.v_m_per_s); }};
}

// Of the speed's power, opposing the motion, as a share of Coulomb at top speed.
Law drag(const Hidden& hidden, const Machine& m, int power) {
  const double top_N = sized(hidden, 0.6, 1.4) * m.coulomb_N;
  const double top = m.top_speed_m_per_s;
  return {.on_load_N = [=](const Now& now) {
    return -top_N * direction(now.v_m_per_s) * std::pow(std::abs(now.v_m_per_s) / top, power);
  }};
}
Law quadratic_drag(const Hidden& hidden, const Machine& m) {
  return drag(hidden, m, 2);
}
Law cubic_viscous(const Hidden& hidden, const Machine& m) {
  return drag(hidden, m, 3);
}

Law stribeck(const Hidden& hidden, const Machine& m) {
  const double more_N = sized(hidden, 0.4, 0.9) * m.coulomb_N;
  const double speed = m.top_speed_m_per_s * (0.015 + 0.035 * hidden.place);
  return {.dry_N = [=](const Now& now) {
    return more_N * std::exp(-std::pow(now.v_m_per_s / speed, 2));
  }};
}

// Friction that grows from little at rest: a film, or a sign that is none.
Law low_speed_rolloff(const Hidden& hidden, const Machine& m) {
  const double less_N = sized(hidden, 0.5, 0.9) * m.coulomb_N;
  const double speed = m.top_speed_m_per_s * (0.02 + 0.04 * hidden.place);
  return {.dry_N = [=](const Now& now) {
    return -less_N * std::exp(-std::abs(now.v_m_per_s) / speed);
  }};
}

Law stiction(const Hidden& hidden, const Machine& m) {
  return {.breakaway_N = sized(hidden, 0.5, 1.0) * m.coulomb_N};
}

Law presliding(const Hidden& hidden, const Machine& m) {
  return {.presliding_m = sized(hidden, 0.002, 0.006) * m.stroke_m};
}

Law load_dependent(const Hidden& hidden, const Machine& /*m*/) {
  const double share = sized(hidden, 0.08, 0.2);
  return {.dry_N = [=](const Now& now) { return share * std::abs(now.drive_N); }};
}

Law thermal_drift(const Hidden& hidden, const Machine& m) {
  const double cold_N = sized(hidden, 0.25, 0.45) * m.coulomb_N;
  const double warm_after_s = 20 + 40 * hidden.place;
  return {.dry_N = [=](const Now& now) { return cold_N * std::exp(-now.t_s / warm_after_s); }};
}

// Friction that falls where its own heat is, and recovers in seconds.
Law work_warming(const Hidden& hidden, const Machine& m) {
  constexpr double kCools_s = 6;
  const double share = sized(hidden, 0.4, 0.7);
  auto warmth = std::make_shared<double>(0);  // 1 after long travel at top speed
  Law law;
  law.memory_N = [=](const Now& now) {
    const double heat = 2 * std::abs(now.v_m_per_s) / m.top_speed_m_per_s;
    *warmth += now.h_s / kCools_s * (heat - *warmth);
    return 0.0;
  };
  law.dry_N = [=](const Now&) { return -share * m.coulomb_N * std::tanh(*warmth); };
  return law;
}

}  // namespace

std::vector<Effect> friction_effects() {
  const std::string family = "friction";
  const std::string slow = "low_speed";
  const std::vector<std::string> constant{"coulomb_asymmetry", "constant_bias", "bias"};
  return {
      {"coulomb", family, {"coulomb"}, {}, Span::kCoulomb, any_machine, coulomb},
      {"viscous", family, {"viscous"}, {}, Span::kViscous, any_machine, viscous},
      {"coulomb_asymmetry", family, constant, {}, Span::kBias, any_machine, coulomb_asymmetry},
      {"viscous_asymmetry",
       family,
       {"viscous_asymmetry"},
       {},
       Span::kNone,
       any_machine,
       viscous_asymmetry},
      {"quadratic_drag", family, {"quadratic_drag"}, {}, Span::kNone, any_machine, quadratic_drag},
      {"cubic_viscous", family, {"cubic_viscous"}, {}, Span::kNone, any_machine, cubic_viscous},
      {"load_dependent_friction",
       family,
       {"load_dependent_friction"},
       {},
       Span::kNone,
       rigid,
       load_dependent},
      {"stribeck", slow, {"stribeck"}, {}, Span::kNone, any_machine, stribeck},
      {"low_speed_rolloff",
       slow,
       {"low_speed_rolloff"},
       {},
       Span::kNone,
       any_machine,
       low_speed_rolloff},
      {"stiction", slow, {"stiction", "stribeck"}, {}, Span::kNone, any_machine, stiction},
      {"presliding", slow, {"presliding"}, {}, Span::kNone, rigid, presliding},
      {"thermal_drift",
       "session",
       {"thermal_drift"},
       {"coulomb"},
       Span::kNone,
       any_machine,
       thermal_drift},
      {"work_warming",
       "session",
       {"thermal_drift"},
       {"coulomb", "viscous", "inertia", "bias", "constant_bias"},
       Span::kNone,
       any_machine,
       work_warming,
       true},
  };
}

}  // namespace towbench::tests::foreign
