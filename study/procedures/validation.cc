// Validation: what was identified against motions that no estimate has seen. Twice, each time
// through the plant fixture that is handed out:
//
//   open loop    the logged duty through the model; what the encoder says beyond it over spans s,
//                e(t) = [n(t) - n(t - s)] - [m(t) - m(t - s)]
//   closed loop  the same motion by the same controller on the model as a machine; the duty that it
//                takes against the logged one. The gain is by how much less of the duty stays
//                unexplained than with the machine as the controller believed it.
#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include <fmt/format.h>

#include "harness/fixtures/rig_fixture.h"
#include "study/identify/two_mass_simulation.h"
#include "study/procedures/believed_model.h"
#include "study/procedures/duty_apart.h"
#include "study/procedures/identified_plant.h"
#include "study/procedures/procedures.h"
#include "study/procedures/settings.h"

namespace towbench::study::procedures {
namespace {

struct ValidationSettings {
  double speed_m_per_s = 0.25;
  double distance_m = 1.0;
  double amplitude_m = 0.15;
  double frequency_Hz = 0.3;
  double place_share = 0.45;
  double span_s = 0.2;

  template <typename Visitor>
  void visit(Visitor& v) {
    v.value("speed_m_per_s", speed_m_per_s, core::between(0.02, 0.6), "of the trapezoids");
    v.value("distance_m", distance_m, core::between(0.05, 3), "of the trapezoids");
    v.value("amplitude_m", amplitude_m, core::between(0.01, 0.5), "of the sinusoid");
    v.value("frequency_Hz", frequency_Hz, core::between(0.05, 2), "of the sinusoid");
    v.value("place_share", place_share, core::between(0.1, 0.9), "of the track, where it begins");
    v.value("span_s", span_s, core::between(0.02, 2), "over which motion is compared");
  }
};

// Each begins at rest, the transmission slack: how a motion leaves a carriage that sticks depends
// on hundredths of a millimetre, and the next one would begin differently on a machine of equal
// bits.
struct Motion {
  const char* name;   // of the conversation
  const char* title;  // in tables
  double starts_at;   // share of the distance
  double sign;        // of the way; 0: a sinusoid
};
constexpr std::array<Motion, 3> kMotions{{{"out", "trapezoid out", 0, 1},
                                          {"back", "trapezoid back", 1, -1},
                                          {"sinus", "sinusoid", 0, 0}}};

struct Left {
  double rms_counts = 0;
  double peak_counts = 0;
  bool simulated = false;
};

constexpr double kMoving_m_per_s = 0.01;

// More than that of the duty's RMS is no model of the machine.
constexpr double kMostUnexplained = 0.05;

// What of a motion the model leaves in open loop. Not of rest and of what is as slow: there a loop
// may hold an axis with a duty that is within a hundredth of break-away, and then any model runs
// away that has break-away a hundredth too low.
Left left_by(const emulator::AxisParameters& axis, const identify::DrivePath& path,
             const identify::Recording& data, core::Axis which, double span_s) {
  Left left;
  const auto counts = identify::simulate_counts(axis, path, data, which);
  if (!counts) {
    return left;
  }
  left.simulated = true;
  const auto span = static_cast<std::size_t>(std::lround(span_s / data.period_s));
  const auto& measured = data.axes[which].count;
  double square = 0;
  std::size_t rows = 0;
  const auto& wanted_m_per_s = data.axes[which].reference_velocity_m_per_s;
  for (std::size_t k = span; k < data.rows(); ++k) {
    if (std::min(std::fabs(wanted_m_per_s[k]), std::fabs(wanted_m_per_s[k - span])) <
        kMoving_m_per_s) {
      continue;
    }
    const double e = static_cast<double>(measured[k] - measured[k - span]) -
                     ((*counts)[k] - (*counts)[k - span]);
    square += e * e;
    left.peak_counts = std::max(left.peak_counts, std::fabs(e));
    ++rows;
  }
  left.rms_counts = std::sqrt(square / static_cast<double>(std::max<std::size_t>(rows, 1)));
  return left;
}

class Validation final : public Procedure {
 public:
  [[nodiscard]] std::string_view id() const noexcept override { return "validation"; }
  [[nodiscard]] std::string_view title() const noexcept override { return "Fresh trajectories"; }
  void check_settings(const std::filesystem::path& file) const override {
    static_cast<void>(read_settings<ValidationSettings>(file, core::Axis::kY));
  }

  [[nodiscard]] ProcedureOutcome run(const ProcedureContext& context) const override {
    const auto settings = read_settings<ValidationSettings>(context.settings, context.axis);
    if (context.find("inertia_kg_m2") == nullptr) {
      return ProcedureOutcome::refused("no model: EXP-OL-2 gave none");
    }
    const auto track = track_of(context.machine.configuration().axes[context.axis]);
    const double start_m = track.min_m + settings.place_share * track.length_m();
    const double reach_m = std::max(settings.distance_m, 2 * settings.amplitude_m);
    if (start_m + reach_m > track.max_m) {
      return ProcedureOutcome::refused(
          fmt::format("no travel: {:.2f} m from {:.2f} m, the track ends at {:.2f} m", reach_m,
                      start_m, track.max_m));
    }
    // Through the file that is handed out, not past it.
    const auto text = identified_plant(context.machine, context.known);
    if (const auto why = contradiction(text); !why.empty()) {
      return ProcedureOutcome::refused("the identified plant contradicts itself: " + why);
    }
    const auto plant =
        harness::read_plant(harness::FixtureFile::parse(text, "identified_plant.toml"));
    auto identified = plant.parameters.axes[context.axis].plant;
    identified.hard_ends.fitted = false;
    const ProcedureContext before{.machine = context.machine, .axis = context.axis};
    const auto believed = believed_axis(before);
    const auto path = believed_path(context);

    ResultTable table{
        .title = fmt::format("What each model leaves: encoder in motion over {} s, counts RMS "
                             "(peak); duty, % RMS",
                             settings.span_s),
        .head = {"motion", "identified, encoder", "identified, duty", "controller's belief, duty",
                 "gain"}};
    const auto identified_reference = context.machine.reference(context.axis, identified);
    const auto believed_reference = context.machine.reference(context.axis, believed);
    ProcedureOutcome outcome;
    double counts_square = 0;
    double duty_square = 0;
    double belief_square = 0;
    double model_square = 0;
    for (const auto& motion : kMotions) {
      const auto data = play(context, context.machine, settings, start_m, motion);
      if (!data.trouble.empty()) {
        return ProcedureOutcome::failed(data.trouble);
      }
      const auto left = left_by(identified, path, data, context.axis, settings.span_s);
      const auto now = play(context, identified_reference, settings, start_m, motion);
      const auto old = play(context, believed_reference, settings, start_m, motion);
      if (!left.simulated || !now.trouble.empty()) {
        return ProcedureOutcome::failed("the identified plant cannot do the motion: " +
                                        now.trouble);
      }
      const double by_model = duty_apart_pct(data, now, context.axis);
      const double by_belief = duty_apart_pct(data, old, context.axis);
      counts_square += left.rms_counts * left.rms_counts;
      belief_square += by_belief * by_belief;
      duty_square += std::pow(duty_rms_pct(data, context.axis), 2);
      model_square += by_model * by_model;
      table.rows.push_back({motion.title,
                            fmt::format("{:.1f} ({:.0f})", left.rms_counts, left.peak_counts),
                            fmt::format("{:.3f}", by_model), fmt::format("{:.3f}", by_belief),
                            fmt::format("{:.1f}", by_belief / by_model)});
      outcome.figures.push_back(
          speed_figure(data, context.axis, fmt::format("Speed, fresh {}", motion.title)));
      outcome.figures.push_back(duty_figure(data, now, old, context.axis, motion));
      context.tell(static_cast<double>(&motion - kMotions.data() + 1) / kMotions.size());
    }
    const double gain = std::sqrt(belief_square / model_square);
    const double unexplained = std::sqrt(model_square / duty_square);
    if (!(unexplained < kMostUnexplained)) {
      return ProcedureOutcome::failed(fmt::format(
          "the identified plant leaves {:.1f} % of the duty of fresh motions unexplained "
          "(the controller's belief {:.1f} %), {:.0f} % are allowed",
          100 * unexplained, 100 * std::sqrt(belief_square / duty_square), 100 * kMostUnexplained));
    }
    const auto add = [&](const char* quantity, double value, const char* unit) {
      outcome.estimates.push_back(
          {.quantity = quantity,
           .axis = std::string(core::name_of(context.axis)),
           .value = value,
           .low = value,
           .high = value,
           .unit = unit,
           .rests_on =
               "trapezoids and a sinusoid in closed loop that no estimate has seen, through "
               "the plant fixture that is handed out",
           .procedure = "validation"});
    };
    add("validation_left_counts", std::sqrt(counts_square / kMotions.size()), "counts RMS");
    add("validation_unexplained_pct", 100 * unexplained, "% of the duty's RMS");
    add("validation_gain", gain, "1");
    outcome.tables.push_back(std::move(table));
    return outcome;
  }

 private:
  static Figure duty_figure(const identify::Recording& data, const identify::Recording& now,
                            const identify::Recording& old, core::Axis which,
                            const Motion& motion) {
    constexpr std::size_t kPoints = 1500;
    Figure figure{.title = fmt::format("Duty, fresh {}", motion.title),
                  .x_label = "time, s",
                  .y_label = "duty, %"};
    for (const auto& [name, log] : {std::pair{"measured", &data}, std::pair{"identified", &now},
                                    std::pair{"controller's belief", &old}}) {
      Curve curve{.name = name};
      const std::size_t every = std::max<std::size_t>(1, log->rows() / kPoints);
      for (std::size_t k = 0; k < log->rows(); k += every) {
        curve.x.push_back(log->time_s[k]);
        curve.y.push_back(log->axes[which].duty_pct[k]);
      }
      figure.curves.push_back(std::move(curve));
    }
    return figure;
  }

  static identify::Recording play(const ProcedureContext& context, const Machine& machine,
                                  const ValidationSettings& settings, double start_m,
                                  const Motion& motion) {
    const auto name = core::name_of(context.axis);
    Conversation talk{.name = fmt::format("validation-{}-{}", name, motion.name)};
    talk.start_m = middle_of_tracks(context.machine);
    talk.start_m[context.axis] = start_m + motion.starts_at * settings.distance_m;
    talk.steps = declare_position(talk, context.machine);
    talk.steps.push_back(move(
        motion.sign == 0
            ? fmt::format("run -sinus {} --amplitude {}m --frequency {}Hz --turns 3 --entry 2s",
                          name, settings.amplitude_m, settings.frequency_Hz)
            : fmt::format("run -trapez {} --distance {}m --speed {}m/s", name,
                          motion.sign * settings.distance_m, settings.speed_m_per_s)));
    talk.limit_s = 120;
    return machine.play(talk, studied_configuration(context));
  }
};

}  // namespace

std::unique_ptr<Procedure> validation() {
  return std::make_unique<Validation>();
}

}  // namespace towbench::study::procedures
