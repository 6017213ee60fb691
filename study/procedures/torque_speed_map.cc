// EXP-CL-1: friction against speed, from trapezoids at many speeds, both ways over the same place.
//
// Every steady stretch has its middle at the same place, so that friction of the place is the same
// in all of them and the law of speed stands alone.
//
// Below the Stribeck speed the carriage can stick and slip on its transmission while the motor runs
// evenly: the mean torque is then below the friction at that speed, the law's fall looks too steep
// and its line too flat. The identified plant does the same in the same experiment, so the law is
// that plant's and what the differences of both say (identify/paired_law.h).
#include <algorithm>
#include <cmath>
#include <optional>

#include <fmt/format.h>

#include "harness/fixtures/rig_fixture.h"
#include "study/identify/bent_line.h"
#include "study/identify/friction_law.h"
#include "study/identify/paired_law.h"
#include "study/identify/window_means.h"
#include "study/procedures/believed_model.h"
#include "study/procedures/identified_plant.h"
#include "study/procedures/procedures.h"
#include "study/procedures/settings.h"
#include "study/procedures/steady_speeds.h"
#include "study/statistics/statistics.h"

namespace towbench::study::procedures {
namespace {

using identify::SteadyRun;

struct TorqueSpeedMapSettings {
  double place_share = 0.5;
  double slowest_way_m = 0.01;
  double longest_way_m = 0.5;
  double shortest_s = 2;
  double fastest_share = 0.7;

  template <typename Visitor>
  void visit(Visitor& v) {
    v.value("place_share", place_share, core::between(0.2, 0.8),
            "of the track: middle of all runs");
    v.value("slowest_way_m", slowest_way_m, core::between(1e-3, 0.2), "shortest steady stretch");
    v.value("longest_way_m", longest_way_m, core::between(0.01, 2), "longest steady stretch");
    v.value("shortest_s", shortest_s, core::between(0.2, 20), "steady, where the way allows");
    v.value("fastest_share", fastest_share, core::between(0.1, 0.95),
            "of the saturation speed; faster runs are left out");
  }
};

constexpr double kRise_s = 0.3;
constexpr double kWait_s = 0.5;
constexpr double kSettle_s = 0.6;  // until the transmission and the law are quiet

class TorqueSpeedMap final : public Procedure {
 public:
  [[nodiscard]] std::string_view id() const noexcept override { return "EXP-CL-1"; }
  [[nodiscard]] std::string_view title() const noexcept override { return "Torque-speed map"; }
  void check_settings(const std::filesystem::path& file) const override {
    static_cast<void>(read_settings<TorqueSpeedMapSettings>(file, core::Axis::kY));
  }

  [[nodiscard]] ProcedureOutcome run(const ProcedureContext& context) const override {
    const auto settings = read_settings<TorqueSpeedMapSettings>(context.settings, context.axis);
    const auto& belief = context.machine.configuration().axes[context.axis];
    const auto track = track_of(belief);
    const double middle_m = track.min_m + settings.place_share * track.length_m();
    const double top = settings.fastest_share *
                       value_or(context, "saturation_speed_m_per_s", belief.speed_limit_m_per_s);
    const auto speeds = speeds_up_to(top);
    const double room = 0.9 * 2 * std::min(middle_m - track.min_m, track.max_m - middle_m);
    for (const double speed : speeds) {
      if (whole_way(settings, speed) > room) {
        return ProcedureOutcome::refused(
            fmt::format("no travel: {:.3f} m/s takes {:.2f} m, there are {:.2f} m", speed,
                        whole_way(settings, speed), room));
      }
    }
    const auto measured = collect(context, settings, speeds, middle_m, 0.6);
    if (!measured.trouble.empty()) {
      return ProcedureOutcome::failed(measured.trouble);
    }
    return judged(context, settings, speeds, measured, middle_m);
  }

 private:
  struct Collected {
    std::vector<SteadyRun> runs{};
    std::size_t stalled = 0;
    std::string trouble{};
  };

  static double whole_way(const TorqueSpeedMapSettings& settings, double speed) {
    return std::clamp(speed * (settings.shortest_s + kSettle_s), settings.slowest_way_m,
                      settings.longest_way_m) +
           speed * kRise_s;
  }

  static Collected collect(const ProcedureContext& context, const TorqueSpeedMapSettings& settings,
                           const std::vector<double>& speeds, double middle_m, double share) {
    Collected collected;
    for (std::size_t i = 0; i < speeds.size(); ++i) {
      const double whole = whole_way(settings, speeds[i]);
      const auto data = play(context, speeds[i], whole, middle_m);
      if (!data.trouble.empty()) {
        collected.trouble = fmt::format("at {} m/s: {}", speeds[i], data.trouble);
        return collected;
      }
      collected.stalled += take(context, data, speeds[i], whole, collected.runs);
      context.tell(share * static_cast<double>(i + 1) / static_cast<double>(speeds.size()));
    }
    return collected;
  }

  // S - C, where break-away and pulses have told it.
  static std::optional<double> excess_of(const ProcedureContext& context) {
    const auto* known = context.find("stiction_excess_Nm");
    return known == nullptr ? std::nullopt : std::optional(known->value);
  }

  // The law of the machine by its simulated reference's.
  struct Corrected {
    identify::FrictionLaw shown_by_reference;  // what the simulated reference's runs look like
    identify::FrictionLaw of_reference;        // what they are
    identify::LawShift shift;
  };

  // C and what belongs to the place.
  static double friction_at(const emulator::AxisParameters& axis, double place_m) {
    const auto& table = axis.friction.position;
    identify::BentLine of_place;
    of_place.x.assign(table.position_m.begin(), table.position_m.end());
    of_place.y.assign(table.friction_Nm.begin(), table.friction_Nm.end());
    return axis.coulomb_friction_Nm + of_place.at(place_m);
  }

  // The same experiment on the identified plant, whose law is known. Nothing when there is no such
  // plant.
  static std::optional<Corrected> beside_reference(const ProcedureContext& context,
                                                   const TorqueSpeedMapSettings& settings,
                                                   const std::vector<double>& speeds,
                                                   double middle_m,
                                                   const std::vector<SteadyRun>& runs) {
    const auto* stribeck = context.find("stribeck_speed_rad_per_s");
    const auto* excess = context.find("stiction_excess_Nm");
    if (stribeck == nullptr || excess == nullptr || context.find("inertia_kg_m2") == nullptr) {
      return std::nullopt;
    }
    const auto text = identified_plant(context.machine, context.known);
    if (!contradiction(text).empty()) {
      return std::nullopt;
    }
    const auto plant =
        harness::read_plant(harness::FixtureFile::parse(text, "identified_plant.toml"));
    const auto& of_reference = plant.parameters.axes[context.axis].plant;
    const auto reference = context.machine.reference(context.axis, of_reference);
    const auto seen = collect({.machine = reference, .axis = context.axis, .known = context.known},
                              settings, speeds, middle_m, 0);
    Corrected corrected;
    corrected.shown_by_reference =
        identify::fit_friction_law(seen.runs, stribeck->value, excess_of(context));
    corrected.of_reference.coulomb_Nm = friction_at(of_reference, middle_m);
    corrected.of_reference.excess_Nm =
        of_reference.friction.breakaway_Nm - of_reference.coulomb_friction_Nm;
    corrected.of_reference.stribeck_rad_per_s = of_reference.friction.stribeck_speed_rad_per_s;
    corrected.of_reference.viscous_Nm_s_per_rad = of_reference.viscous_friction_Nm_s_per_rad;
    corrected.shift = identify::find_law_shift(
        corrected.of_reference, excess->half_width() / statistics::kNormal95, runs, seen.runs);
    if (!seen.trouble.empty() || !corrected.shown_by_reference.found || !corrected.shift.found) {
      return std::nullopt;
    }
    return corrected;
  }

  static identify::Recording play(const ProcedureContext& context, double speed, double whole,
                                  double middle_m) {
    Conversation talk{.name =
                          fmt::format("EXP-CL-1-{}-{:.4f}", core::name_of(context.axis), speed)};
    talk.start_m = middle_of_tracks(context.machine);
    talk.start_m[context.axis] = middle_m - 0.5 * whole;
    talk.steps = declare_position(talk, context.machine);
    for (const double sign : {1.0, -1.0}) {
      talk.steps.push_back(move(fmt::format(
          "run -trapez {} --distance {:.6f}m --speed {}m/s --acceleration {}s --wait {}s",
          core::name_of(context.axis), sign * whole, speed, kRise_s, kWait_s)));
    }
    talk.limit_s = 3 * whole / speed + 60;
    return context.machine.play(talk, studied_configuration(context));
  }

  // The steady stretches of a forth and back. Returns how many of them stuck and slipped.
  static std::size_t take(const ProcedureContext& context, const identify::Recording& data,
                          double speed, double whole, std::vector<SteadyRun>& runs) {
    const auto scale = torque_scale(context);
    const auto& axis = data.axes[context.axis];
    std::size_t stalled = 0;
    const double settle_m = std::min(kSettle_s * speed, 0.3 * whole);
    for (const double sign : {1.0, -1.0}) {
      std::size_t from = data.rows();
      std::size_t to = 0;
      for (std::size_t k = 0; k < data.rows(); ++k) {
        if (std::fabs(axis.reference_velocity_m_per_s[k] - sign * speed) < 1e-9 * speed) {
          from = std::min(from, k);
          to = k;
        }
      }
      from += static_cast<std::size_t>(settle_m / speed / data.period_s);
      const auto torque = identify::mean_of(axis.duty_pct, from, to);
      if (!std::isfinite(torque.standard_error)) {
        continue;
      }
      if (sticks(data, context.axis, from, to, speed)) {
        ++stalled;  // the mean of stick-slip is no friction at a speed
        continue;
      }
      // The speed itself may drift a little, and the mean of a rounded duty is that good at best.
      const double rounding = 0.1 / std::sqrt(12.0 * static_cast<double>(to - from) / 20);
      runs.push_back({.speed_rad_per_s = sign * speed / data.metres_per_count[context.axis] *
                                         data.rad_per_count[context.axis],
                      .torque_Nm = torque.value * scale.torque_per_duty_Nm,
                      .standard_error_Nm =
                          std::hypot(torque.standard_error, rounding) * scale.torque_per_duty_Nm,
                      .position_m = 0.5 * (data.position_m(context.axis, from) +
                                           data.position_m(context.axis, to))});
    }
    return stalled;
  }

  static ProcedureOutcome judged(const ProcedureContext& context,
                                 const TorqueSpeedMapSettings& settings,
                                 const std::vector<double>& speeds, const Collected& measured,
                                 double middle_m) {
    const auto& runs = measured.runs;
    const auto stalled = measured.stalled;
    const double first =
        context.machine.configuration().axes[context.axis].friction.stribeck_speed_rad_per_s;
    const auto law = identify::fit_friction_law(runs, first, excess_of(context));
    if (!law.found || !(law.excess_Nm > 0)) {
      return ProcedureOutcome::failed(fmt::format(
          "{} steady stretches show no friction law; {} stuck and slipped", runs.size(), stalled));
    }
    const auto scale = torque_scale(context);
    ProcedureOutcome outcome;
    const auto add = [&](const char* quantity, double value, double standard_error,
                         const char* unit, bool scales) {
      outcome.estimates.push_back(identify::with_standard_error(
          {.quantity = quantity,
           .axis = std::string(core::name_of(context.axis)),
           .value = value,
           .unit = unit,
           .rests_on = fmt::format("means of {} steady stretches around {:.2f} m, {} left out "
                                   "because they stuck and slipped; {} form; torque by {}",
                                   runs.size(), middle_m, stalled,
                                   law.lorentz ? "Lorentz (3.26)" : "Gaussian (3.25)",
                                   scale.measured ? "EXP-P-1" : "the believed K_T K_amp"),
           .procedure = "EXP-CL-1"},
          std::hypot(standard_error, scales ? value * scale.relative_standard_error : 0.0)));
    };
    add("map_excess_Nm", law.excess_Nm, law.excess_standard_error_Nm, "N m", true);
    const auto corrected = beside_reference(context, settings, speeds, middle_m, runs);
    context.tell(1);
    if (corrected) {
      const auto& [shown, reference, shift] = *corrected;
      add("map_stribeck_rad_per_s", reference.stribeck_rad_per_s + shift.stribeck_rad_per_s,
          shift.stribeck_standard_error, "rad/s", false);
      add("map_viscous_Nm_s_per_rad", reference.viscous_Nm_s_per_rad + shift.viscous_Nm_s_per_rad,
          shift.viscous_standard_error, "N m s/rad", true);
      add("map_coulomb_Nm", reference.coulomb_Nm + shift.coulomb_Nm,
          shift.coulomb_standard_error_Nm, "N m", true);
      outcome.estimates.back().at = middle_m;
    }
    add_pictures(runs, law, stalled, corrected, outcome);
    return outcome;
  }

  static void add_pictures(const std::vector<SteadyRun>& runs, const identify::FrictionLaw& law,
                           std::size_t stalled, const std::optional<Corrected>& corrected,
                           ProcedureOutcome& outcome) {
    Curve measured{.name = "steady runs, 95 %", .mark = Mark::kDots};
    Curve fitted{.name = "law"};
    Curve places{.name = "steady runs", .mark = Mark::kDots};
    double top = 0;
    for (const auto& run : runs) {
      measured.x.push_back(run.speed_rad_per_s);
      measured.y.push_back(1e3 * run.torque_Nm);
      measured.low.push_back(1e3 * (run.torque_Nm - statistics::kNormal95 * run.standard_error_Nm));
      measured.high.push_back(1e3 *
                              (run.torque_Nm + statistics::kNormal95 * run.standard_error_Nm));
      places.x.push_back(run.position_m);
      places.y.push_back(1e3 * std::fabs(run.torque_Nm));
      top = std::max(top, std::fabs(run.speed_rad_per_s));
    }
    for (int i = -200; i <= 200; ++i) {
      const double w = top * i / 200 * std::fabs(i / 200.0);
      fitted.x.push_back(w);
      fitted.y.push_back(i == 0 ? std::nan("") : 1e3 * std::copysign(law.at(w), w));
    }
    outcome.figures.push_back({.title = "Torque against speed",
                               .x_label = "motor speed, rad/s",
                               .y_label = "torque, mN m",
                               .curves = {std::move(measured), std::move(fitted)},
                               .caption = "Compare Figs 7.10 to 7.12."});
    ResultTable beside{
        .title = "The law, seen and corrected",
        .head = {"", "seen", "shown by a simulated reference", "the reference's own", "corrected"}};
    const auto row = [&](const char* name, double identify::FrictionLaw::*of,
                         double identify::LawShift::*by) {
      const auto told = [](double value) { return fmt::format("{:.4g}", value); };
      beside.rows.push_back(
          {name, told(law.*of),
           corrected ? told(corrected->shown_by_reference.*of) : "no model yet",
           corrected ? told(corrected->of_reference.*of) : "",
           corrected ? told(corrected->of_reference.*of + corrected->shift.*by) : "withheld"});
    };
    row("Stribeck speed, rad/s", &identify::FrictionLaw::stribeck_rad_per_s,
        &identify::LawShift::stribeck_rad_per_s);
    row("C at the place, N m", &identify::FrictionLaw::coulomb_Nm, &identify::LawShift::coulomb_Nm);
    row("B, N m s/rad", &identify::FrictionLaw::viscous_Nm_s_per_rad,
        &identify::LawShift::viscous_Nm_s_per_rad);
    outcome.tables.push_back(std::move(beside));
    outcome.figures.push_back({.title = "Torque against position",
                               .x_label = "position, m",
                               .y_label = "torque, mN m",
                               .curves = {std::move(places)},
                               .caption = "Compare Fig. 7.13."});
    outcome.tables.push_back(
        {.title = "Friction law",
         .head = {"form", "steady stretches", "stuck and slipped", "residual, N m"},
         .rows = {{law.lorentz ? "Lorentz (3.26)" : "Gaussian (3.25)",
                   fmt::format("{}", runs.size()), fmt::format("{}", stalled),
                   fmt::format("{:.2e}", law.residual_rms_Nm)}}});
  }
};

}  // namespace

std::unique_ptr<Procedure> torque_speed_map() {
  return std::make_unique<TorqueSpeedMap>();
}

}  // namespace towbench::study::procedures
