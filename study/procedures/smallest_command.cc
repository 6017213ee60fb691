// EXP-P-4: the smallest step of duty that brings an axis to its saturation speed within its
// mechanical time constant (thesis 4.1.2), bracketed by halving.
//
// "To" is 98 % of what EXP-P-3 found: the last bit is asymptotic. The speed at the end of a step is
// a straight line through its last part, longer than a swing of the transmission.
#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "study/procedures/believed_model.h"
#include "study/procedures/procedures.h"
#include "study/procedures/settings.h"

namespace towbench::study::procedures {
namespace {

struct SmallestCommandSettings {
  double bracket_pct = 0.5;
  double start_share = 0.1;
  double most_pct = 60;

  template <typename Visitor>
  void visit(Visitor& v) {
    v.value("bracket_pct", bracket_pct, core::between(0.1, 5), "width at which halving ends");
    v.value("start_share", start_share, core::between(0.0, 0.5), "of the track, where it starts");
    v.value("most_pct", most_pct, core::between(5, 100), "duty at which it gives up");
  }
};

constexpr double kArrived = 0.98;

// Speed at the last moment of the stretch of duty.
double end_speed(const identify::Recording& data, core::Axis axis, double over_s) {
  const auto& duty = data.axes[axis].duty_pct;
  std::size_t end = data.rows();
  while (end > 1 && duty[end - 1] == 0) {
    --end;
  }
  // Braking after the step has the other sign.
  const auto first = static_cast<std::size_t>(
      std::find_if(duty.begin(), duty.end(), [](double each) { return each != 0; }) - duty.begin());
  std::size_t last = first;
  while (last < end && duty[last] == duty[first]) {
    ++last;
  }
  const auto span = static_cast<std::size_t>(std::lround(over_s / data.period_s));
  if (last < first + span + 1) {
    return 0;
  }
  // Speeds of the two halves of the last part, carried on to its end.
  const std::size_t half = span / 2;
  const auto speed = [&](std::size_t from, std::size_t to) {
    return (data.position_m(axis, to) - data.position_m(axis, from)) /
           (data.time_s[to] - data.time_s[from]);
  };
  const double before = speed(last - 2 * half, last - half);
  const double after = speed(last - half, last - 1);
  return after + 0.5 * (after - before);
}

class SmallestCommand final : public Procedure {
 public:
  [[nodiscard]] std::string_view id() const noexcept override { return "EXP-P-4"; }
  [[nodiscard]] std::string_view title() const noexcept override {
    return "Smallest command to saturation";
  }
  void check_settings(const std::filesystem::path& file) const override {
    static_cast<void>(read_settings<SmallestCommandSettings>(file, core::Axis::kY));
  }

  [[nodiscard]] ProcedureOutcome run(const ProcedureContext& context) const override {
    const auto settings = read_settings<SmallestCommandSettings>(context.settings, context.axis);
    const double time_s = value_or(context, "mechanical_time_constant_s", 0);
    const double saturation = value_or(context, "saturation_speed_m_per_s", 0);
    if (time_s <= 0 || saturation <= 0) {
      return ProcedureOutcome::refused("needs what EXP-P-2 and EXP-P-3 find");
    }
    const auto track = track_of(context.machine.configuration().axes[context.axis]);
    const double start_m = track.min_m + settings.start_share * track.length_m();
    const double room_m = 0.9 * track.max_m - start_m;
    if (kFastestShare * saturation * time_s > room_m) {
      return ProcedureOutcome::refused(fmt::format(
          "no travel: {:.2f} s up to {:.2f} m/s take up to {:.2f} m, there are {:.2f} m", time_s,
          saturation, kFastestShare * saturation * time_s, room_m));
    }
    // No step above this can take longer than the believed friction and the measured B allow.
    double low_pct = 0;
    double high_pct = 0;
    double middle_m = start_m;
    ResultTable table{.title = fmt::format("Steps of {:.2f} s", time_s),
                      .head = {"duty, %", "speed at the end, m/s", "of saturation, %"}};
    double next_pct = first_guess_pct(context, time_s, saturation);
    while (high_pct == 0 || high_pct - low_pct > settings.bracket_pct + 1e-9) {
      const auto data = play(context, next_pct, time_s, start_m, room_m, saturation);
      if (!data.trouble.empty()) {
        return ProcedureOutcome::failed(fmt::format("at {} %: {}", next_pct, data.trouble));
      }
      const double speed = std::fabs(end_speed(data, context.axis, kLastPart * time_s));
      table.rows.push_back({fmt::format("{:.1f}", next_pct), fmt::format("{:.4f}", speed),
                            fmt::format("{:.1f}", 100 * speed / saturation)});
      if (speed >= kArrived * saturation) {
        high_pct = next_pct;
        middle_m = 0.5 * (start_m + data.position_m(context.axis, data.rows() - 1));
      } else {
        low_pct = next_pct;
      }
      next_pct = high_pct == 0 ? 1.5 * next_pct : 0.5 * (low_pct + high_pct);
      next_pct = std::round(10 * next_pct) / 10;
      if (next_pct > settings.most_pct) {
        return ProcedureOutcome::failed(
            fmt::format("{:.0f} % of duty do not reach {:.2f} m/s in {:.2f} s", low_pct,
                        kArrived * saturation, time_s));
      }
      context.tell(high_pct == 0 ? 0.2 : std::clamp(1 - (high_pct - low_pct) / high_pct, 0.2, 1.0));
    }
    const double by_time_pct = 0.5 * (low_pct + high_pct) * share_by_time(context);
    ProcedureOutcome outcome;
    outcome.estimates.push_back(
        {.quantity = "smallest_command_pct",
         .axis = std::string(core::name_of(context.axis)),
         .value = 0.5 * (low_pct + high_pct),
         .low = low_pct - by_time_pct,
         .high = high_pct + by_time_pct,
         .unit = "%",
         .rests_on =
             fmt::format("steps of {:.3f} s around {:.2f} m; reached is {:.0f} % of the "
                         "saturation speed; the interval is the bracket and what that time's own "
                         "interval makes of it",
                         time_s, middle_m, 100 * kArrived),
         .procedure = "EXP-P-4",
         .at = middle_m});
    outcome.tables.push_back(std::move(table));
    return outcome;
  }

 private:
  // By how much of itself the command is off when the time of the step is off by its interval:
  // D ~ 1 / (1 - exp(-t/T)), so d ln D / d ln t = -1 / (e - 1) at t = T, less where friction takes
  // a part of D.
  static double share_by_time(const ProcedureContext& context) {
    constexpr double kSteepest = 0.582;
    const auto* time = context.find("mechanical_time_constant_s");
    return time == nullptr ? 0.0 : kSteepest * time->half_width() / time->value;
  }

  // (C + B w_s / (1 - 1/e)) / k, B = J / T, by the controller's belief of J and C.
  static double first_guess_pct(const ProcedureContext& context, double time_s, double saturation) {
    const auto axis = believed_axis(context);
    const double w = saturation / context.machine.nameplate(context.axis).metres_per_motor_rad();
    const double torque =
        axis.coulomb_friction_Nm + axis.inertia_kg_m2 / time_s * w / (1 - std::exp(-1.0));
    return std::round(10 * torque / torque_scale(context).torque_per_duty_Nm) / 10;
  }

  static identify::Recording play(const ProcedureContext& context, double duty_pct, double time_s,
                                  double start_m, double room_m, double saturation) {
    Conversation talk{.name = fmt::format("EXP-P-4-{}-{}", core::name_of(context.axis), duty_pct)};
    talk.start_m = middle_of_tracks(context.machine);
    talk.start_m[context.axis] = start_m;
    talk.steps = declare_position(talk, context.machine);
    // At saturation speed all the way there would be no room for longer.
    const double longest_s = std::min(time_s, room_m / (kFastestShare * saturation));
    talk.steps.push_back(
        move(fmt::format("rmpi step {} --duty {:.1f}% -d + --time {:.4f}s --wait 0.2s --rest 0s",
                         core::name_of(context.axis), duty_pct, longest_s)));
    talk.limit_s = time_s + 20;
    return context.machine.play(talk, studied_configuration(context));
  }

  static constexpr double kLastPart = 0.2;       // of a step, in which its end speed is read
  static constexpr double kFastestShare = 0.85;  // mean over final speed, of the strongest step
};

}  // namespace

std::unique_ptr<Procedure> smallest_command() {
  return std::make_unique<SmallestCommand>();
}

}  // namespace towbench::study::procedures
