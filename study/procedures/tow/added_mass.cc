// Added mass (3.9) of the towed object from sinusoidal tows in and out of the water.
#include <cmath>
#include <numbers>

#include <fmt/format.h>

#include "study/identify/tow/drag_law.h"
#include "study/identify/tow/sinusoidal_tow.h"
#include "study/procedures/settings.h"
#include "study/procedures/tow/feasibility.h"
#include "study/procedures/tow/tow_procedure.h"
#include "study/procedures/tow/weigh_drive.h"

namespace towbench::study::procedures {
namespace {

using core::Axis;

struct AddedMassSettings {
  double amplitude_m = 0.15;
  core::BoundedVector<double, 16> frequencies_Hz;
  double turns = 10;
  double start_y_m = 1.0;
  double start_x_m = 0.3368;
  WeighSettings weigh;

  AddedMassSettings() noexcept {
    for (const double frequency : {0.28, 0.34, 0.40, 0.46}) {
      (void)frequencies_Hz.push_back(frequency);
    }
  }

  template <typename Visitor>
  void visit(Visitor& v) {
    v.value("amplitude_m", amplitude_m, core::between(0.01, 0.5), "half the way from end to end");
    v.list("frequencies_Hz", frequencies_Hz, core::between(0.05, 2.0), "of the sines");
    v.value("turns", turns, core::between(6.0, 200.0), "oscillations");
    v.value("start_y_m", start_y_m, core::between(0.0, 10.0), "one end of the motion");
    v.value("start_x_m", start_x_m, core::between(0.0, 10.0), "where X is held");
    v.group("weigh", weigh, "the drive's scale by a known weight");
  }
  [[nodiscard]] double peak_speed_m_per_s(double frequency_Hz) const {
    return 2 * std::numbers::pi * frequency_Hz * amplitude_m;
  }
  [[nodiscard]] double mean_rate_rad_per_s() const {
    double sum = 0;
    for (const double frequency : frequencies_Hz) {
      sum += 2 * std::numbers::pi * frequency;
    }
    return sum / static_cast<double>(frequencies_Hz.size());
  }
  [[nodiscard]] double peak_acceleration(double frequency_Hz) const {
    return 2 * std::numbers::pi * frequency_Hz * peak_speed_m_per_s(frequency_Hz);
  }
};

Conversation sine(const Machine& machine, const std::string& name, const AddedMassSettings& s,
                  double frequency_Hz) {
  Conversation talk;
  talk.name = fmt::format("{}, {:.3f} Hz", name, frequency_Hz);
  talk.start_m[Axis::kY] = s.start_y_m;
  talk.start_m[Axis::kX] = s.start_x_m;
  talk.steps = declare_position(talk, machine);
  talk.steps.push_back(
      move(fmt::format("run -sinus y --amplitude {:.4f}m --frequency {:.4f}Hz --turns {} "
                       "--entry 2s",
                       s.amplitude_m, frequency_Hz, s.turns),
           s.turns / frequency_Hz + 30));
  talk.limit_s = s.turns / frequency_Hz + 60;
  return talk;
}

// What one frequency gives is one repeat: what the transmission's swing and the reversals' friction
// leave in it differs from frequency to frequency.
struct Repeats {
  std::vector<double> by_sensor;
  std::vector<double> by_drive;
  std::vector<double> drag;
};

class AddedMass final : public TowProcedure {
 public:
  [[nodiscard]] std::string_view id() const noexcept override { return "added-mass"; }
  [[nodiscard]] std::string_view title() const noexcept override {
    return "added mass from a sinusoidal tow";
  }
  void check_settings(const std::filesystem::path& file) const override {
    static_cast<void>(read_settings<AddedMassSettings>(file, Axis::kY));
  }
  [[nodiscard]] Load load() const override { return {.rig = "tow-cylinder"}; }

  [[nodiscard]] TowOutcome run(const TowContext& context) const override {
    const auto s = read_settings<AddedMassSettings>(context.settings, Axis::kY);
    const auto dry = context.loads.with({});
    const auto wet = context.loads.with(load());
    for (auto why :
         {no_axis(wet, Axis::kY), no_force_sensor(wet), not_in_water(context.loads, load()),
          no_travel(wet, Axis::kY, s.start_y_m, s.start_y_m + 2 * s.amplitude_m),
          why_not(dry, Axis::kY, s.weigh)}) {
      if (!why.empty()) {
        return tow_refused(why);
      }
    }
    for (const double frequency : s.frequencies_Hz) {
      if (auto why = too_fast(wet, Axis::kY, s.peak_speed_m_per_s(frequency),
                              s.peak_acceleration(frequency));
          !why.empty()) {
        return tow_refused(why);
      }
    }
    const auto weighed = weigh_drive(dry, Axis::kY, s.weigh);
    if (!weighed.trouble.empty()) {
      return tow_failed(weighed.trouble);
    }
    Repeats repeats;
    for (const double frequency : s.frequencies_Hz) {
      const auto in = wet.play(sine(wet, "sine in the water", s, frequency));
      const auto out = dry.play(sine(dry, "sine out of the water", s, frequency));
      for (const auto* each : {&in, &out}) {
        if (!each->trouble.empty()) {
          return tow_failed(each->trouble);
        }
      }
      if (!add(in, out, weighed, repeats)) {
        return tow_failed("fewer than two whole periods");
      }
      context.tell(static_cast<double>(repeats.drag.size()) /
                   static_cast<double>(s.frequencies_Hz.size()));
    }
    auto outcome = told(
        repeats, identify::doubt_by_transmission(weighed.transmission, s.mean_rate_rad_per_s()));
    outcome.simulated_s = dry.simulated_s() + wet.simulated_s();
    return outcome;
  }

 private:
  static bool add(const identify::Recording& in, const identify::Recording& out,
                  const WeighedDrive& weighed, Repeats& repeats) {
    constexpr std::size_t kSkip = 2;
    const auto sensor = identify::sinusoidal_force(in, out, Axis::kY, weighed.transmission, kSkip);
    // Whole periods: what friction does at the reversals has no part in phase with acceleration.
    const auto drive = identify::sinusoidal_tow(
        in, in.axes[Axis::kY].duty_pct, out, out.axes[Axis::kY].duty_pct, Axis::kY,
        {.scale = weighed.scale.force_per_duty_N, .skip = kSkip});
    if (!sensor || !drive) {
      return false;
    }
    repeats.by_sensor.push_back(sensor->added_mass_kg.value);
    repeats.by_drive.push_back(drive->added_mass_kg.value);
    repeats.drag.push_back(sensor->quadratic_drag_N_s2_per_m2.value);
    return true;
  }

  // `doubt`: of drag, by the transmission, as a share of it; all frequencies have it in common.
  static TowOutcome told(const Repeats& repeats, double doubt) {
    TowOutcome outcome;
    const std::string by_sensor =
        "force sensor in the water and out of it, the carriage's own motion behind its "
        "transmission; "
        "scatter between frequencies";
    const auto drag = identify::doubted(identify::mean_of_repeats(repeats.drag), doubt,
                                        identify::kTransmissionDegreesOfFreedom);
    outcome.estimates = {
        identify::to_estimate(identify::mean_of_repeats(repeats.by_sensor), "fsm_added_mass_kg",
                              "y", "kg", by_sensor),
        identify::withheld(
            identify::to_estimate(identify::mean_of_repeats(repeats.by_drive), "mcd_added_mass_kg",
                                  "y", "kg",
                                  "duty in the water less out of it, scaled by a known weight"),
            "what the carriage swings after reversals does not cancel: half of the value"),
        identify::to_estimate(drag, "sine_drag_N_s2_per_m2", "y", "N s2/m2", by_sensor)};
    return outcome;
  }
};

}  // namespace

std::unique_ptr<TowProcedure> added_mass() {
  return std::make_unique<AddedMass>();
}

}  // namespace towbench::study::procedures
