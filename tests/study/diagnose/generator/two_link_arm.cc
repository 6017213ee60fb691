#include "tests/study/diagnose/generator/two_link_arm.h"

#include <array>
#include <cmath>
#include <random>

namespace towbench::tests {
namespace {

struct State {
  double q1 = 0, q2 = 0, w1 = 0, w2 = 0;
};

State operator+(const State& s, const State& d) {
  return {s.q1 + d.q1, s.q2 + d.q2, s.w1 + d.w1, s.w2 + d.w2};
}
State operator*(double h, const State& d) {
  return {h * d.q1, h * d.q2, h * d.w1, h * d.w2};
}

State rate(const TwoLinkArm& arm, const State& s, double torque1, double torque2) {
  const auto rubs = [&](double w) {
    return arm.viscous_Nm_s_per_rad * w + arm.coulomb_Nm * std::tanh(w / 0.002);
  };
  const double c = std::cos(s.q2);
  const double h = -arm.b_kg_m2 * std::sin(s.q2);
  const double m11 = arm.a_kg_m2 + 2 * arm.b_kg_m2 * c;
  const double m12 = arm.d_kg_m2 + arm.b_kg_m2 * c;
  const double m22 = arm.d_kg_m2;
  const double outer = arm.weight_2_Nm * std::sin(s.q1 + s.q2);
  const double f1 = torque1 - rubs(s.w1) - h * s.w2 * s.w1 - h * (s.w1 + s.w2) * s.w2 -
                    arm.weight_1_Nm * std::sin(s.q1) - outer;
  const double f2 = torque2 - rubs(s.w2) + h * s.w1 * s.w1 - outer;
  if (!arm.second_moves) return {s.w1, 0, f1 / m11, 0};
  const double det = m11 * m22 - m12 * m12;
  return {s.w1, s.w2, (m22 * f1 - m12 * f2) / det, (m11 * f2 - m12 * f1) / det};
}

void step(const TwoLinkArm& arm, State& s, double torque1, double torque2, double h) {
  const State k1 = rate(arm, s, torque1, torque2);
  const State k2 = rate(arm, s + 0.5 * h * k1, torque1, torque2);
  const State k3 = rate(arm, s + 0.5 * h * k2, torque1, torque2);
  const State k4 = rate(arm, s + h * k3, torque1, torque2);
  s = s + h / 6 * (k1 + 2 * k2 + 2 * k3 + k4);
}

class Reference {
 public:
  explicit Reference(std::mt19937_64& draw) {
    for (std::size_t i = 0; i < amplitude_.size(); ++i) {
      const auto number = [&](double low, double high) {
        return std::uniform_real_distribution<double>(low, high)(draw);
      };
      hertz_[i] = number(0.1, 0.3) * static_cast<double>(1 + i);
      amplitude_[i] = number(0.15, 0.25) / hertz_[i];
      phase_[i] = number(0, 6.28);
    }
  }
  [[nodiscard]] double at(double t) const {
    double sum = 0;
    for (std::size_t i = 0; i < amplitude_.size(); ++i) {
      sum += amplitude_[i] * std::sin(6.283185307 * hertz_[i] * t + phase_[i]);
    }
    return sum;
  }

 private:
  std::array<double, 4> hertz_{}, amplitude_{}, phase_{};
};

}  // namespace

ArmLog make_arm_log(const TwoLinkArm& arm, std::uint64_t seed) {
  std::mt19937_64 draw(seed);
  const Reference first(draw);
  const Reference second(draw);
  constexpr int kSteps = 50;
  ArmLog log;
  State s{first.at(0), arm.second_share * second.at(0), 0, 0};
  double before1 = s.q1;
  double before2 = s.q2;
  const auto counted = [&](double q) {
    return std::floor(q * arm.counts_per_rad) / arm.counts_per_rad;
  };
  for (double t = 0; t < arm.duration_s; t += arm.period_s) {
    const double q1 = counted(s.q1);
    const double q2 = counted(s.q2);
    const double torque1 = 400 * (first.at(t) - q1) - 30 * (q1 - before1) / arm.period_s;
    const double torque2 =
        150 * (arm.second_share * second.at(t) - q2) - 8 * (q2 - before2) / arm.period_s;
    before1 = q1;
    before2 = q2;
    log.time_s.push_back(t);
    log.q1_rad.push_back(q1);
    log.q2_rad.push_back(q2);
    log.torque1_Nm.push_back(torque1);
    log.torque2_Nm.push_back(torque2);
    for (int i = 0; i < kSteps; ++i) step(arm, s, torque1, torque2, arm.period_s / kSteps);
  }
  return log;
}

}  // namespace towbench::tests
