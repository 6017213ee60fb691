#include "study/procedures/pulse_plan.h"

#include <algorithm>
#include <array>
#include <cmath>

#include <fmt/format.h>

#include "study/procedures/believed_model.h"
#include "study/procedures/procedures.h"

namespace towbench::study::procedures {
namespace {

// Speed gained is a (D - D0) t: a in m/s^2 per % duty, D0 what friction eats.
struct Response {
  double per_duty = 0;
  double friction_duty = 0;
};

constexpr double kProbeOn_s = 0.12;

// Mean speed over the 0.12 s after the first pulse, in which the transmission swings about once.
double speed_after_pulse(const identify::Recording& data, core::Axis axis) {
  const auto& duty = data.axes[axis].duty_pct;
  std::size_t k = 0;
  while (k < data.rows() && duty[k] == 0) {
    ++k;
  }
  while (k < data.rows() && duty[k] != 0) {
    ++k;
  }
  const auto span = static_cast<std::size_t>(std::lround(0.12 / data.period_s));
  if (k + span >= data.rows()) {
    return 0;
  }
  return (data.position_m(axis, k + span) - data.position_m(axis, k)) /
         (data.time_s[k + span] - data.time_s[k]);
}

double probe(const ProcedureContext& context, double duty_pct, double start_m, PulsePlan& plan) {
  Conversation talk{.name = fmt::format("probe-{}-{}", core::name_of(context.axis), duty_pct)};
  talk.start_m = middle_of_tracks(context.machine);
  talk.start_m[context.axis] = start_m;
  talk.steps = declare_position(talk, context.machine);
  talk.steps.push_back(
      move(fmt::format("rmpi si {} --duty {}% --on {}s --off 0.4s --pulses 2 --alternate",
                       core::name_of(context.axis), duty_pct, kProbeOn_s)));
  const auto data = context.machine.play(talk, studied_configuration(context));
  if (!data.trouble.empty()) {
    plan.refusal = "the probing pulse: " + data.trouble;
    return 0;
  }
  return speed_after_pulse(data, context.axis);
}

// How far alternating pulses take a body with that response, at most; and where they end.
double reach(const Response& r, const PulseLimits& limits, double duty_pct, int pulses) {
  constexpr double kStep_s = 2e-3;
  double x = 0;
  double v = 0;
  double far = 0;
  const auto drive = [&](double duty, double time_s) {
    for (double t = 0; t < time_s; t += kStep_s) {
      const double pull = r.per_duty * duty;
      const double brake = r.per_duty * r.friction_duty;
      const double free = v + kStep_s * pull;
      v = std::copysign(std::max(0.0, std::fabs(free) - kStep_s * brake), free);
      x += kStep_s * v;
      far = std::max(far, std::fabs(x));
    }
  };
  for (int i = 0; i < pulses; ++i) {
    drive(i % 2 == 0 ? duty_pct : -duty_pct, limits.on_s);
    drive(0, limits.off_s);
  }
  drive(0, 3);
  return far;
}

}  // namespace

PulsePlan plan_pulses(const ProcedureContext& context, const PulseLimits& limits, double start_m) {
  PulsePlan plan;
  const auto scale = torque_scale(context);
  const auto& belief = context.machine.configuration().axes[context.axis];
  const double largest_pct =
      100 * std::min(1.0, belief.drive.current_limit_A /
                              (belief.drive.amplifier_gain_A_per_V * belief.drive.pwm_amplitude_V));
  const double worst_pct = belief.plausibility.worst_breakaway_Nm / scale.torque_per_duty_Nm;
  if (2.5 * worst_pct > largest_pct) {
    plan.refusal = fmt::format(
        "stall: break-away may take {:.1f} % duty of {:.0f} % that the "
        "current limit leaves",
        worst_pct, largest_pct);
    return plan;
  }
  const std::array<double, 2> duties{std::round(15 * worst_pct) / 10,
                                     std::round(25 * worst_pct) / 10};
  std::array<double, 2> speeds{};
  for (std::size_t i = 0; i < duties.size(); ++i) {
    speeds.at(i) = std::fabs(probe(context, duties.at(i), start_m, plan));
    if (!plan.refusal.empty()) {
      return plan;
    }
    context.tell(0.05 * static_cast<double>(i + 1));
  }
  Response response;
  response.per_duty = (speeds[1] - speeds[0]) / (duties[1] - duties[0]) / kProbeOn_s;
  response.friction_duty = duties[1] - speeds[1] / (response.per_duty * kProbeOn_s);
  if (!(response.per_duty > 0) || !(response.friction_duty < duties[1])) {
    plan.refusal = fmt::format("stall: pulses of {:.1f} % and {:.1f} % gave {:.3g} and {:.3g} m/s",
                               duties[0], duties[1], speeds[0], speeds[1]);
    return plan;
  }
  response.friction_duty = std::max(response.friction_duty, 0.2);
  const double saturation =
      value_or(context, "saturation_speed_m_per_s", belief.speed_limit_m_per_s);
  plan.duty_pct =
      response.friction_duty + limits.peak_share * saturation / (response.per_duty * limits.on_s);
  plan.duty_pct = std::round(10 * plan.duty_pct) / 10;
  if (plan.duty_pct > 0.9 * largest_pct) {
    plan.refusal = fmt::format(
        "saturation: {:.0f} % of the saturation speed in {} s takes {:.0f} % duty, the current "
        "limit is at {:.0f} %",
        100 * limits.peak_share, limits.on_s, plan.duty_pct, largest_pct);
    return plan;
  }
  const auto track = track_of(belief);
  const double room = std::min(limits.longest_m, 0.7 * (track.max_m - start_m));
  plan.pulses = limits.most_pulses;
  while (plan.pulses > 2 && reach(response, limits, plan.duty_pct, plan.pulses) > room) {
    plan.pulses -= 2;
  }
  plan.reach_m = reach(response, limits, plan.duty_pct, plan.pulses);
  if (plan.reach_m > room) {
    plan.refusal =
        fmt::format("no travel: two pulses go {:.2f} m, there are {:.2f} m", plan.reach_m, room);
  }
  return plan;
}

}  // namespace towbench::study::procedures
