// EXP-CL-2: friction against place, the second half of the thesis's EXP-CL-1 (4.1.2: "the same data
// set is also used to infer the position dependent friction").
//
// Two steady runs along the whole track, forth and back, both far above the Stribeck speed:
//
//   tau(x, w) = C + tau_P(x) + B w        (3.33), (3.34), steady
//
// Their difference is B (w2 - w1) at every place, which separates speed from place; what is left
// is a line through places, with as many bends as the data bear (identify/bent_line.h).
//
// Two speeds do not tell how friction falls from break-away S. By (3.26), (S - C)/(1 + (w/w_s)^2)
// is left at w, by (3.25) nothing; intervals hold the difference, w_s as it is believed.
#include <algorithm>
#include <array>
#include <cmath>

#include <fmt/format.h>

#include "study/identify/bent_line.h"
#include "study/identify/window_means.h"
#include "study/procedures/believed_model.h"
#include "study/procedures/procedures.h"
#include "study/procedures/settings.h"
#include "study/statistics/statistics.h"

namespace towbench::study::procedures {
namespace {

struct TorquePlaceMapSettings {
  double slow_m_per_s = 0.1;
  double fast_m_per_s = 0.3;
  double rise_s = 1.0;
  double bin_m = 0.05;
  double start_share = 0.04;
  int most_bends = 8;

  template <typename Visitor>
  void visit(Visitor& v) {
    v.value("slow_m_per_s", slow_m_per_s, core::between(0.02, 0.5), "steady, above Stribeck's");
    v.value("fast_m_per_s", fast_m_per_s, core::between(0.03, 0.7), "steady");
    v.value("rise_s", rise_s, core::between(0.1, 5), "from rest to speed");
    v.value("bin_m", bin_m, core::between(2e-3, 0.5), "over which torque is averaged");
    v.value("start_share", start_share, core::between(0.0, 0.4), "of the track, left out at ends");
    v.value("most_bends", most_bends, core::between(0, 12), "of the map");
  }
};

// One bin of one speed: both directions.
struct Level {
  double place_m = 0;
  double torque_Nm = 0;
  double standard_error_Nm = 0;
};

class TorquePlaceMap final : public Procedure {
 public:
  [[nodiscard]] std::string_view id() const noexcept override { return "EXP-CL-2"; }
  [[nodiscard]] std::string_view title() const noexcept override { return "Torque-position map"; }
  void check_settings(const std::filesystem::path& file) const override {
    static_cast<void>(read_settings<TorquePlaceMapSettings>(file, core::Axis::kY));
  }

  [[nodiscard]] ProcedureOutcome run(const ProcedureContext& context) const override {
    const auto settings = read_settings<TorquePlaceMapSettings>(context.settings, context.axis);
    const auto track = track_of(context.machine.configuration().axes[context.axis]);
    const double from_m = track.min_m + settings.start_share * track.length_m();
    const double way_m = (1 - 2 * settings.start_share) * track.length_m();
    const std::array<double, 2> speeds{settings.slow_m_per_s, settings.fast_m_per_s};
    const double steady_m = way_m - 3 * speeds[1] * settings.rise_s;
    if (speeds[1] < 1.5 * speeds[0] || steady_m < 8 * settings.bin_m) {
      return ProcedureOutcome::refused(fmt::format(
          "no travel: at {:.2f} m/s {:.2f} m of {:.2f} m are steady, eight bins take {:.2f} m",
          speeds[1], std::max(0.0, steady_m), way_m, 8 * settings.bin_m));
    }
    std::array<std::vector<Level>, 2> levels;
    for (std::size_t i = 0; i < speeds.size(); ++i) {
      const auto data = play(context, settings, speeds.at(i), from_m, way_m);
      if (!data.trouble.empty()) {
        return ProcedureOutcome::failed(fmt::format("at {} m/s: {}", speeds.at(i), data.trouble));
      }
      levels.at(i) = levels_of(context, settings, data, speeds.at(i), from_m, way_m);
      context.tell(0.5 * static_cast<double>(i + 1));
    }
    return judged(context, settings, speeds, levels);
  }

 private:
  static identify::Recording play(const ProcedureContext& context,
                                  const TorquePlaceMapSettings& settings, double speed,
                                  double from_m, double way_m) {
    const auto& belief = context.machine.configuration().axes[context.axis];
    Conversation talk{.name = fmt::format("EXP-CL-2-{}-{}", core::name_of(context.axis), speed)};
    talk.start_m = middle_of_tracks(context.machine);
    talk.start_m[context.axis] = from_m;
    talk.steps = declare_position(talk, context.machine);
    for (const double sign : {1.0, -1.0}) {
      // Smoothed over a swing of the carriage on its transmission, so that it does not go on
      // swinging.
      talk.steps.push_back(move(fmt::format(
          "run -trapez {} --distance {:.6f}m --speed {}m/s --acceleration {}s --smooth {:.3f}s",
          core::name_of(context.axis), sign * way_m, speed, settings.rise_s,
          1 / belief.braking.held_motor_chain_Hz)));
    }
    talk.limit_s = 3 * way_m / speed + 60;
    return context.machine.play(talk, studied_configuration(context));
  }

  static std::vector<Level> levels_of(const ProcedureContext& context,
                                      const TorquePlaceMapSettings& settings,
                                      const identify::Recording& data, double speed, double from_m,
                                      double way_m) {
    const auto scale = torque_scale(context).torque_per_duty_Nm;
    const double edge_m = 1.5 * speed * settings.rise_s;
    const auto bins = static_cast<std::size_t>((way_m - 2 * edge_m) / settings.bin_m);
    std::vector<Level> levels(bins);
    std::vector<int> seen(bins, 0);
    const auto& axis = data.axes[context.axis];
    std::size_t begin = 0;
    const auto bin_of = [&](std::size_t k) {
      const bool steady =
          std::fabs(std::fabs(axis.reference_velocity_m_per_s[k]) / speed - 1) < 1e-6;
      const double share = (data.position_m(context.axis, k) - from_m - edge_m) / settings.bin_m;
      return steady && share >= 0 && share < static_cast<double>(bins) ? static_cast<long>(share)
                                                                       : -1L;
    };
    for (std::size_t k = 1; k <= data.rows(); ++k) {
      const long bin = bin_of(begin);
      if (k < data.rows() && bin_of(k) == bin) {
        continue;
      }
      const auto mean = identify::mean_of(axis.duty_pct, begin, k);
      if (bin >= 0 && std::isfinite(mean.standard_error)) {
        auto& level = levels[static_cast<std::size_t>(bin)];
        level.place_m = from_m + edge_m + (static_cast<double>(bin) + 0.5) * settings.bin_m;
        level.torque_Nm += 0.5 * std::fabs(mean.value) * scale;
        level.standard_error_Nm = std::hypot(
            level.standard_error_Nm, 0.5 * std::max(mean.standard_error, kRounding_pct) * scale);
        ++seen[static_cast<std::size_t>(bin)];
      }
      begin = k;
    }
    std::vector<Level> whole;
    for (std::size_t i = 0; i < bins; ++i) {
      if (seen[i] == 2) {
        whole.push_back(levels[i]);
      }
    }
    return whole;
  }

  static ProcedureOutcome judged(const ProcedureContext& context,
                                 const TorquePlaceMapSettings& settings,
                                 const std::array<double, 2>& speeds,
                                 const std::array<std::vector<Level>, 2>& levels) {
    const double rad_per_m = 1 / context.machine.nameplate(context.axis).metres_per_motor_rad();
    const auto scale = torque_scale(context);
    // B from the bins that both runs saw.
    double weight = 0;
    double sum = 0;
    double square = 0;
    double n = 0;
    for (const auto& slow : levels[0]) {
      for (const auto& fast : levels[1]) {
        if (std::fabs(slow.place_m - fast.place_m) < 0.5 * settings.bin_m) {
          const double w = 1 / (slow.standard_error_Nm * slow.standard_error_Nm +
                                fast.standard_error_Nm * fast.standard_error_Nm);
          const double more = fast.torque_Nm - slow.torque_Nm;
          sum += w * more;
          square += w * more * more;
          weight += w;
          n += 1;
        }
      }
    }
    if (n < 2) {
      return ProcedureOutcome::failed("the two runs have fewer than two steady places in common");
    }
    const double apart = (speeds[1] - speeds[0]) * rad_per_m;
    const double viscous = sum / weight / apart;
    // By how far the places are from telling the same.
    const double scatter = std::max(0.0, square - sum * sum / weight) / (n - 1);
    const double slow_w = speeds[0] * rad_per_m;
    const double slow_tail_Nm = lorentz_tail_Nm(context, levels[0], viscous * slow_w, slow_w);
    const double fast_tail_Nm =
        lorentz_tail_Nm(context, levels[0], viscous * slow_w, speeds[1] * rad_per_m);
    const double viscous_standard_error =
        (std::sqrt(scatter / weight) + (slow_tail_Nm - fast_tail_Nm) / statistics::kNormal95) /
        apart;
    std::vector<identify::LinePoint> points;
    for (std::size_t i = 0; i < speeds.size(); ++i) {
      for (const auto& each : levels.at(i)) {
        points.push_back({each.place_m, each.torque_Nm - viscous * speeds.at(i) * rad_per_m,
                          each.standard_error_Nm});
      }
    }
    const auto map = identify::fit_bent_line(points, settings.most_bends);
    if (map.x.empty()) {
      return ProcedureOutcome::failed(fmt::format("{} bins are too few", points.size()));
    }
    ProcedureOutcome outcome;
    const auto add = [&](const char* quantity, double value, double standard_error,
                         const char* unit) {
      outcome.estimates.push_back(identify::with_standard_error(
          {.quantity = quantity,
           .axis = std::string(core::name_of(context.axis)),
           .value = value,
           .unit = unit,
           .rests_on = fmt::format("means over {} m of steady runs at {} and {} m/s, both ways; "
                                   "torque by {}",
                                   settings.bin_m, speeds[0], speeds[1],
                                   scale.measured ? "EXP-P-1" : "the believed K_T K_amp"),
           .procedure = "EXP-CL-2"},
          std::hypot(standard_error, value * scale.relative_standard_error)));
    };
    add("steady_viscous_Nm_s_per_rad", viscous, viscous_standard_error, "N m s/rad");
    for (std::size_t i = 0; i < map.x.size(); ++i) {
      add("sliding_friction_Nm", map.y[i],
          std::hypot(map.standard_error[i], viscous_standard_error * slow_w) +
              slow_tail_Nm / statistics::kNormal95,
          "N m");
      outcome.estimates.back().at = map.x[i];
    }
    add_figure(points, map, outcome);
    return outcome;
  }

  static void add_figure(const std::vector<identify::LinePoint>& points,
                         const identify::BentLine& map, ProcedureOutcome& outcome) {
    Curve measured{.name = "means of both ways, less B w", .mark = Mark::kDots};
    for (const auto& point : points) {
      measured.x.push_back(point.x);
      measured.y.push_back(1e3 * point.y);
    }
    Curve line{.name = fmt::format("line with {} bends", map.x.size() - 2), .x = map.x};
    for (const double y : map.y) {
      line.y.push_back(1e3 * y);
    }
    outcome.figures.push_back({.title = "Torque against position",
                               .x_label = "position, m",
                               .y_label = "torque, mN m",
                               .curves = {std::move(measured), std::move(line)},
                               .caption = "Compare Fig. 7.13."});
  }

  // S by the ramps where they were made, else as it is believed; C by `levels` less `viscous_Nm`.
  static double lorentz_tail_Nm(const ProcedureContext& context, const std::vector<Level>& levels,
                                double viscous_Nm, double speed_rad_per_s) {
    double excess_Nm = 0;
    double n = 0;
    for (const auto& each : context.known) {
      if (each.quantity == "breakaway_Nm" && each.axis == core::name_of(context.axis)) {
        const auto near = std::min_element(
            levels.begin(), levels.end(), [&](const Level& one, const Level& other) {
              return std::fabs(one.place_m - *each.at) < std::fabs(other.place_m - *each.at);
            });
        excess_Nm +=
            each.value - (near == levels.end() ? each.value : near->torque_Nm - viscous_Nm);
        n += 1;
      }
    }
    const auto& belief = context.machine.configuration().axes[context.axis];
    const auto believed = believed_axis(context);
    excess_Nm =
        n > 0 ? excess_Nm / n : believed.friction.breakaway_Nm - believed.coulomb_friction_Nm;
    const double ratio = speed_rad_per_s / belief.friction.stribeck_speed_rad_per_s;
    return std::max(0.0, excess_Nm) / (1 + ratio * ratio);
  }

  static constexpr double kRounding_pct = 2e-3;  // of a mean of duties in steps of 0.1 %
};

}  // namespace

std::unique_ptr<Procedure> torque_place_map() {
  return std::make_unique<TorquePlaceMap>();
}

}  // namespace towbench::study::procedures
