#include "tests/study/diagnose/foreign/dry_bodies.h"

#include <algorithm>
#include <cmath>

namespace towbench::tests::foreign {
namespace {

struct Slide {
  double speed = 0;
  double impulse = 0;
};

// mass v + lambda = momentum with lambda in most Sgn(v).
Slide slide(double momentum, double mass, double most) {
  const double impulse = std::clamp(momentum, -most, most);
  return {(momentum - impulse) / mass, impulse};
}

// What a body would bring into the end of the step without friction, and what it weighs there.
double momentum(const Body& body, double h_s, double push_N) {
  return body.mass_kg * body.v_m_per_s +
         h_s * (push_N - 0.5 * body.viscous_N_s_per_m * body.v_m_per_s);
}
double weight(const Body& body, double h_s) {
  return body.mass_kg + 0.5 * h_s * body.viscous_N_s_per_m;
}

void move(Body& body, double h_s, double speed) {
  body.x_m += 0.5 * h_s * (body.v_m_per_s + speed);
  body.v_m_per_s = speed;
}

}  // namespace

ForcePair DryBodies::step(double h_s, ForcePair push, ForcePair grip) {
  return two() ? step_two(h_s, push, grip)
               : step_one(h_s, push.motor_N + push.load_N, grip.motor_N + grip.load_N);
}

ForcePair DryBodies::step_one(double h_s, double push_N, double grip_N) {
  const Slide end = slide(momentum(motor_, h_s, push_N), weight(motor_, h_s), h_s * grip_N);
  move(motor_, h_s, end.speed);
  return {end.impulse / h_s, 0};
}

ForcePair DryBodies::step_two(double h_s, ForcePair push, ForcePair grip) {
  const double half_gap = 0.5 * link_.play_m;
  const double stretch = stretch_m();
  const double past = stretch - std::clamp(stretch, -half_gap, half_gap);
  const bool touches = link_.play_m == 0 || past != 0;
  const double rate = motor_.v_m_per_s - load_.v_m_per_s;
  const double p_motor = momentum(motor_, h_s, push.motor_N);
  const double p_load = momentum(load_, h_s, push.load_N);
  const double m_motor = weight(motor_, h_s);
  const double m_load = weight(load_, h_s);
  // The link's impulse: what it is for certain, and a part that grows with the rate at the end.
  double certain = 0;
  double growing = 0;
  if (touches) {
    growing = h_s * (0.25 * h_s * link_.stiffness_N_per_m + 0.5 * link_.damping_N_s_per_m);
    certain = h_s * link_.stiffness_N_per_m * past + growing * rate;
  }
  Slide motor;
  Slide load;
  const auto solve = [&] {
    constexpr int kMost = 60;
    motor.speed = motor_.v_m_per_s;
    load.speed = load_.v_m_per_s;
    for (int i = 0; i < kMost; ++i) {
      const double before = motor.speed + load.speed;
      motor =
          slide(p_motor - certain + growing * load.speed, m_motor + growing, h_s * grip.motor_N);
      load = slide(p_load + certain + growing * motor.speed, m_load + growing, h_s * grip.load_N);
      if (motor.speed + load.speed == before) {
        break;
      }
    }
  };
  solve();
  const double link = certain + growing * (motor.speed - load.speed);
  if (link_.play_m > 0 && link * past < 0) {
    certain = 0;
    growing = 0;
    solve();
  }
  move(motor_, h_s, motor.speed);
  move(load_, h_s, load.speed);
  return {motor.impulse / h_s, load.impulse / h_s};
}

}  // namespace towbench::tests::foreign
