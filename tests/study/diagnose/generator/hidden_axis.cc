#include "tests/study/diagnose/generator/hidden_axis.h"

#include <algorithm>
#include <cmath>
#include <deque>
#include <numbers>

#include "core/random.h"
#include "tests/study/diagnose/generator/hidden_force.h"

namespace towbench::tests {
namespace {

constexpr double kStep_s = 1e-4;
constexpr double kTurn = 2 * std::numbers::pi;

// Trapezoids of drawn speeds and lengths, both ways, with sines between.
std::vector<double> draw_reference(const HiddenAxis& axis, core::Random& random) {
  std::vector<double> r;
  const auto samples = static_cast<std::size_t>(axis.duration_s / axis.period_s);
  double x = 0.5;
  double v = 0;
  double target = 0.5;
  double speed = 0.1;
  double acceleration = 1;
  int moves = 0;
  while (r.size() < samples) {
    const double to_go = target - x;
    if (std::abs(to_go) < 1e-3 && std::abs(v) < 1e-2) {
      const double side = target > 0.5 ? -1 : 1;
      ++moves;
      speed = 0.4 * std::pow(10, -1.5 * random.uniform());
      speed = moves % 4 == 0 ? 0.01 : speed;
      acceleration = 0.4 + 2.0 * random.uniform();
      const double reach = std::min(0.42, 0.05 + 1.2 * speed);
      target = 0.5 + side * reach * (0.4 + 0.6 * random.uniform());
    }
    const double brake = std::sqrt(2 * acceleration * std::abs(to_go));
    const double wish = std::copysign(std::min(speed, brake), to_go);
    v += std::clamp(wish - v, -acceleration * axis.period_s, acceleration * axis.period_s);
    x += v * axis.period_s;
    r.push_back(x);
  }
  return r;
}

// Sines whose motion stays on the rails by itself: friction takes what a drift would need.
double open_loop_force_N(const HiddenAxis& axis, double t_s) {
  const auto sine = [&](double amplitude_N, double frequency_Hz) {
    return amplitude_N * std::sin(kTurn * frequency_Hz * t_s);
  };
  return axis.mass_kg * (sine(0.45, 0.31) + sine(0.5, 0.83) + sine(0.6, 2.1)) +
         1.3 * axis.coulomb_N * std::copysign(1.0, std::sin(kTurn * 0.31 * t_s));
}

class Body {
 public:
  Body(const HiddenAxis& axis, double start_m, std::uint64_t seed)
      : axis_(axis),
        random_(seed ^ 0x5eedU),
        first_(axis.effect, axis.size, random_),
        second_(axis.second_effect, axis.second_size, random_) {
    s_.x_m = where_it_reads(start_m);
    load_m_ = s_.x_m;
  }

  void hold(double command_N, double duration_s) {
    const auto steps = static_cast<int>(std::lround(duration_s / kStep_s));
    for (int i = 0; i < steps; ++i) {
      step(delayed(command_N));
    }
  }
  [[nodiscard]] double read_m() const { return read_at(s_.x_m); }

 private:
  [[nodiscard]] bool has(const char* name) const { return first_.is(name) || second_.is(name); }
  [[nodiscard]] double size_of(const char* name) const {
    return first_.is(name) ? first_.size() : second_.size();
  }
  [[nodiscard]] double read_at(double x_m) const { return second_.read_m(first_.read_m(x_m)); }
  // A controller has brought the reading, not the body, to where the reference begins: otherwise a
  // log would open with a step of full duty.
  [[nodiscard]] double where_it_reads(double reading_m) const {
    constexpr int kEnough = 60;  // for a reading that is off by half of the way
    double x_m = reading_m;
    for (int i = 0; i < kEnough; ++i) {
      x_m += reading_m - read_at(x_m);
    }
    return x_m;
  }

  double delayed(double command_N) {
    history_.push_back(command_N);
    const auto wait = static_cast<std::size_t>((first_.delay_s() + second_.delay_s()) / kStep_s);
    while (history_.size() > wait + 1) {
      history_.pop_front();
    }
    return history_.front();
  }

  void step(double command_N) {
    const double tau = first_.lag_s() + second_.lag_s();
    lagged_ +=
        tau > 0 ? (command_N - lagged_) * (1 - std::exp(-kStep_s / tau)) : command_N - lagged_;
    s_.drive_N = second_.delivered_N(first_.delivered_N(lagged_, s_), s_);
    const double push = s_.drive_N + first_.force_N(s_) + second_.force_N(s_);
    const double hidden = first_.friction_N(s_) + second_.friction_N(s_);
    const double before = s_.v_m_per_s;
    if (has("chain_elasticity") || has("backlash")) {
      two_bodies(push, hidden);
    } else {
      const double mass = axis_.mass_kg + first_.extra_mass_kg() + second_.extra_mass_kg();
      s_.v_m_per_s =
          slide(s_.v_m_per_s, push, mass, axis_.coulomb_N + hidden, axis_.viscous_N_s_per_m);
      s_.x_m += 0.5 * kStep_s * (before + s_.v_m_per_s);
    }
    s_.a_m_per_s2 = (s_.v_m_per_s - before) / kStep_s;
    s_.t_s += kStep_s;
    s_.since_reversal_m += std::abs(s_.v_m_per_s) * kStep_s;
    if (s_.v_m_per_s * direction_ < 0) {
      s_.since_reversal_m = 0;
    }
    direction_ = s_.v_m_per_s != 0 ? s_.v_m_per_s : direction_;
  }

  // One step of a body under a force, with dry friction that can hold it.
  static double slide(double v, double force, double mass, double dry, double viscous) {
    const double free = v + kStep_s * (force - viscous * v) / mass;
    const double loss = kStep_s * std::max(0.0, dry) / mass;
    return std::abs(free) <= loss ? 0.0 : free - std::copysign(loss, free);
  }

  // Motor with a fifth of the mass, the rest behind a spring or a gap. Behind a gap the flanks are
  // stiff in the diagnosis' band: with none left they hide nothing.
  void two_bodies(double push, double hidden) {
    const double motor = 0.21 * axis_.mass_kg;
    const double load = axis_.mass_kg - motor;
    double gap = 0;
    double frequency = 150;
    double damping = 0.3;
    if (has("backlash")) {
      gap = 0.5e-3 * size_of("backlash");
    } else {
      frequency = 7.0 / std::sqrt(size_of("chain_elasticity"));
      damping = 0.05;
    }
    const double stiffness = load * std::pow(kTurn * frequency, 2);
    const double damper = 2 * damping * load * kTurn * frequency;
    const double stretch = s_.x_m - load_m_;
    const double past = std::abs(stretch) <= gap ? 0 : stretch - std::copysign(gap, stretch);
    const double transmission =
        past == 0 ? 0 : stiffness * past + damper * (s_.v_m_per_s - load_v_);
    const double vm = s_.v_m_per_s;
    const double vl = load_v_;
    s_.v_m_per_s = slide(vm, push - transmission, motor, 0.35 * axis_.coulomb_N + hidden,
                         0.35 * axis_.viscous_N_s_per_m);
    load_v_ = slide(vl, transmission, load, 0.65 * axis_.coulomb_N, 0.65 * axis_.viscous_N_s_per_m);
    s_.x_m += 0.5 * kStep_s * (vm + s_.v_m_per_s);
    load_m_ += 0.5 * kStep_s * (vl + load_v_);
  }

  const HiddenAxis& axis_;
  core::Random random_;
  HiddenForce first_;
  HiddenForce second_;
  BodyState s_;
  double load_m_ = 0;
  double load_v_ = 0;
  double lagged_ = 0;
  double direction_ = 0;
  std::deque<double> history_;
};

}  // namespace

HiddenLog make_hidden_log(const HiddenAxis& axis, std::uint64_t seed) {
  core::Random random(seed);
  HiddenLog log;
  log.reference_m = draw_reference(axis, random);
  Body body(axis, log.reference_m.front(), axis.machine == 0 ? seed : axis.machine);
  const double w = kTurn * 4;  // closed-loop bandwidth of the PID
  double integral = 0;
  double last = 0;
  for (std::size_t k = 0; k < log.reference_m.size(); ++k) {
    const double read = (std::floor(body.read_m() * axis.counts_per_m) + 0.5) / axis.counts_per_m;
    const double error = log.reference_m[k] - read;
    integral += error * axis.period_s;
    const double rate = k == 0 ? 0 : (error - last) / axis.period_s;
    last = error;
    const double force =
        axis.mass_kg * (w * w * error + 1.6 * w * rate + 0.8 * w * w * w * integral);
    const double t_s = static_cast<double>(k) * axis.period_s;
    const double wanted_pct =
        (axis.open_loop ? open_loop_force_N(axis, t_s) : force) / axis.newton_per_duty_pct;
    const double duty =
        std::clamp(std::round(wanted_pct / axis.duty_step_pct) * axis.duty_step_pct, -100.0, 100.0);
    log.time_s.push_back(t_s);
    log.position_m.push_back(read);
    log.duty_pct.push_back(duty);
    body.hold(duty * axis.newton_per_duty_pct, axis.period_s);
  }
  return log;
}

}  // namespace towbench::tests
