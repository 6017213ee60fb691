#include "tests/study/diagnose/foreign/way.h"

#include <algorithm>
#include <cmath>

namespace towbench::tests::foreign {
namespace {

constexpr double kLongestLeg_s = 8;

void laps(Way& way, const Machine& m, double duration_s, double low, double high, Dice& dice) {
  for (bool out = true; way.duration_s() < duration_s; out = !out) {
    const double speed = m.top_speed_m_per_s * dice.log_between(low, high);
    const double reach = std::min(m.stroke_m * dice.between(0.5, 1.0), kLongestLeg_s * speed);
    const double to = std::clamp(way.end_m() + (out ? reach : -reach), 0.0, m.stroke_m);
    way.move(to, speed, m.acceleration_m_per_s2 * dice.between(0.4, 1.0));
    way.rest(dice.between(0.05, 0.6));
  }
}

void one_way(Way& way, const Machine& m, double duration_s, Dice& dice) {
  constexpr int kLegs = 4;
  for (int i = 1; i <= kLegs; ++i) {
    const double leg_s = duration_s / kLegs * dice.between(0.5, 0.9);
    const double slowest = m.stroke_m / kLegs / leg_s;
    const double speed =
        std::clamp(m.top_speed_m_per_s * dice.log_between(0.1, 1), slowest, m.top_speed_m_per_s);
    way.move(m.stroke_m * i / kLegs, speed, m.acceleration_m_per_s2 * dice.between(0.4, 1.0));
    way.rest(0.3);
  }
}

void stairs(Way& way, const Machine& m, double duration_s) {
  constexpr double kFactor = 0.6;
  double speed = m.top_speed_m_per_s;
  while (way.duration_s() < duration_s) {
    const double reach = std::min(0.9 * m.stroke_m, 3 * speed);
    way.move(reach, speed, m.acceleration_m_per_s2);
    way.rest(0.2);
    way.move(0, speed, m.acceleration_m_per_s2);
    way.rest(0.2);
    speed = speed < 0.03 * m.top_speed_m_per_s ? m.top_speed_m_per_s : kFactor * speed;
  }
}

// Of one frequency or several, as large as stroke, speed and acceleration allow each.
void sines(Way& way, const Machine& m, int count, Dice& dice) {
  way.jump(0.5 * m.stroke_m);
  for (int i = 0; i < count; ++i) {
    const double low = count == 1 ? 0.2 : 0.1 * std::pow(40.0, static_cast<double>(i) / count);
    const double frequency = count == 1 ? dice.log_between(low, 2) : low * dice.between(1, 1.6);
    const double w = kTurn * frequency;
    const double most =
        std::min({0.5 * m.stroke_m, m.top_speed_m_per_s / w, m.acceleration_m_per_s2 / (w * w)});
    way.swing(most * dice.between(0.6, 1) / std::sqrt(static_cast<double>(count)), frequency,
              kTurn * dice.uniform());
  }
}

void steps(Way& way, const Machine& m, double duration_s, Dice& dice) {
  while (way.duration_s() < duration_s) {
    way.rest(dice.between(0.5, 2));
    way.jump(std::clamp(way.end_m() + dice.sign() * m.stroke_m * dice.log_between(0.02, 0.12), 0.0,
                        m.stroke_m));
  }
}

}  // namespace

void Way::leg(double duration_s, double acceleration_m_per_s2) {
  end_.a_m_per_s2 = acceleration_m_per_s2;
  legs_.push_back({end_s_, end_});
  end_.x_m += duration_s * (end_.v_m_per_s + 0.5 * duration_s * acceleration_m_per_s2);
  end_.v_m_per_s += duration_s * acceleration_m_per_s2;
  end_s_ += duration_s;
}

void Way::rest(double duration_s) {
  end_.v_m_per_s = 0;
  leg(duration_s, 0);
}

void Way::move(double to_m, double speed_m_per_s, double acceleration_m_per_s2) {
  const double way = std::abs(to_m - end_.x_m);
  if (way == 0) {
    return rest(0.1);
  }
  const double sign = to_m > end_.x_m ? 1 : -1;
  const double speed = std::min(speed_m_per_s, std::sqrt(way * acceleration_m_per_s2));
  const double ramp_s = speed / acceleration_m_per_s2;
  leg(ramp_s, sign * acceleration_m_per_s2);
  leg(way / speed - ramp_s, 0);
  leg(ramp_s, -sign * acceleration_m_per_s2);
  end_ = {to_m, 0, 0};
}

void Way::swing(double amplitude_m, double frequency_Hz, double phase_rad) {
  sines_.push_back({amplitude_m, kTurn * frequency_Hz, phase_rad});
}

Wanted Way::at(double t_s) const {
  Wanted wanted = end_;
  const auto after = std::upper_bound(legs_.begin(), legs_.end(), t_s,
                                      [](double t, const Leg& leg) { return t < leg.from_s; });
  if (t_s < end_s_ && after != legs_.begin()) {
    const Leg& now = *(after - 1);
    const double t = t_s - now.from_s;
    wanted = now.start;
    wanted.x_m += t * (wanted.v_m_per_s + 0.5 * t * wanted.a_m_per_s2);
    wanted.v_m_per_s += t * wanted.a_m_per_s2;
  } else {
    wanted.v_m_per_s = 0;
    wanted.a_m_per_s2 = 0;
  }
  const double rise = std::min(1.0, t_s);  // nothing begins at full speed
  for (const Sine& sine : sines_) {
    const double angle = sine.pulsation * t_s + sine.phase_rad;
    const double w = sine.pulsation;
    wanted.x_m += rise * sine.amplitude_m * std::sin(angle);
    wanted.v_m_per_s += rise * sine.amplitude_m * w * std::cos(angle);
    wanted.a_m_per_s2 -= rise * sine.amplitude_m * w * w * std::sin(angle);
  }
  return wanted;
}

Way draw_way(const std::string& motion, const Machine& machine, double duration_s, Dice& dice) {
  const bool from_the_end = motion == "slow_laps" || motion == "fast_laps" || motion == "one_way" ||
                            motion == "stairs" || motion == "pushed";
  Way way(from_the_end ? 0 : 0.5 * machine.stroke_m);
  way.rest(0.3);
  if (motion == "slow_laps") {
    laps(way, machine, duration_s, 0.03, 0.3, dice);
  } else if (motion == "fast_laps" || motion == "pushed") {
    laps(way, machine, duration_s, 0.4, 1.0, dice);
  } else if (motion == "one_way") {
    one_way(way, machine, duration_s, dice);
  } else if (motion == "stairs") {
    stairs(way, machine, duration_s);
  } else if (motion == "sine") {
    sines(way, machine, 1, dice);
  } else if (motion == "multisine" || motion == "hand") {
    sines(way, machine, 5, dice);
  } else if (motion == "prbs") {
    way.swing(0.25 * machine.stroke_m,
              std::min(0.3, machine.top_speed_m_per_s / (kTurn * machine.stroke_m)), 0);
  } else if (motion == "steps") {
    steps(way, machine, duration_s, dice);
  }
  return way;
}

}  // namespace towbench::tests::foreign
