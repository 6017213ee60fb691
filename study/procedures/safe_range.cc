// EXP-P-5: the safe range of motion (thesis 4.1.2): each hall switch approached below the speed
// that can be stopped before the hard end, by the controller's own homing.
//
// A switch acts on the carriage, the encoder sits on the motor, and at the edge the transmission
// between them is stretched by some hundred counts. Homing takes that off by its belief of friction
// and transmission. Here it is taken off again from the log, by the torque at the edge and the
// transmission and the motor's friction that the pulses have found (switch_study.h); so this comes
// after them. The searches, many times faster, tell the same to within a row's way. The min switch
// is the origin.
#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "study/procedures/believed_model.h"
#include "study/procedures/procedures.h"
#include "study/procedures/settings.h"
#include "study/procedures/switch_study.h"
#include "study/procedures/two_mass_report.h"

namespace towbench::study::procedures {
namespace {

struct SafeRangeSettings {
  int repeats = 3;
  double near_m = 0.08;

  template <typename Visitor>
  void visit(Visitor& v) {
    v.value("repeats", repeats, core::between(2, 20), "of the whole, there and back");
    v.value("near_m", near_m, core::between(0.02, 0.5), "from a soft limit, where homing begins");
  }
};

class SafeRange final : public Procedure {
 public:
  [[nodiscard]] std::string_view id() const noexcept override { return "EXP-P-5"; }
  [[nodiscard]] std::string_view title() const noexcept override { return "Safe range of motion"; }
  void check_settings(const std::filesystem::path& file) const override {
    static_cast<void>(read_settings<SafeRangeSettings>(file, core::Axis::kY));
  }

  [[nodiscard]] ProcedureOutcome run(const ProcedureContext& context) const override {
    const auto settings = read_settings<SafeRangeSettings>(context.settings, context.axis);
    const auto& belief = context.machine.configuration().axes[context.axis];
    const auto track = track_of(belief);
    if (track.length_m() < 4 * settings.near_m) {
      return ProcedureOutcome::refused(
          fmt::format("no travel: {:.2f} m between the soft limits, homing wants {:.2f} m",
                      track.length_m(), 4 * settings.near_m));
    }
    const double room_min_m =
        belief.m_per_count() *
        static_cast<double>(belief.ends.hall_min_count - belief.ends.hard_min_count);
    const double room_max_m =
        belief.m_per_count() *
        static_cast<double>(belief.ends.hard_max_count - belief.ends.hall_max_count);
    const auto [transmission, doubts, known] = known_transmission(context);
    const double slow_m_per_s = belief.homing.approach_speed_m_per_s;
    std::vector<Distance> all;
    std::vector<double> doubted(doubts.size(), 0.0);
    ResultTable table{
        .title = "Approaches",
        .head = {"between the motor's counts at the edges", "the transmission's stretch",
                 "between the switches, counts +-", "the same at seeking speed", "weighed",
                 "furthest beyond min switch, mm (room)", "beyond max switch, mm (room)",
                 "controller's own shift, counts"}};
    for (int i = 0; i < settings.repeats; ++i) {
      const auto data = play(context, settings, track, i);
      if (!data.trouble.empty()) {
        return ProcedureOutcome::failed(data.trouble);
      }
      const auto approaches = identify::find_switch_approaches(data, context.axis, slow_m_per_s);
      if (approaches.size() != 2 || approaches[0].outward > 0 || approaches[1].outward < 0 ||
          approaches[0].fast_edge < approaches[0].fast_from + kSeek_rows ||
          approaches[1].fast_edge < approaches[1].fast_from + kSeek_rows) {
        return ProcedureOutcome::failed("the log does not show where the switches closed");
      }
      const SwitchStudy study(data, context.axis, approaches);
      const double beyond_min_m = study.beyond_m(approaches[0]);
      const double beyond_max_m = study.beyond_m(approaches[1]);
      if (beyond_min_m > room_min_m || beyond_max_m > room_max_m) {
        return ProcedureOutcome::failed("the approach went as far as the hard end should be");
      }
      const auto edges = study.edges(transmission);
      const auto weighed = edges.weighed();
      for (std::size_t k = 0; k < doubts.size(); ++k) {
        auto other = transmission;
        other.*doubts[k].what += doubts[k].standard_error;
        doubted[k] += (study.edges(other).weighed().counts - weighed.counts) / settings.repeats;
      }
      all.push_back(weighed);
      table.rows.push_back({fmt::format("{:.1f}", edges.motor_counts),
                            fmt::format("{:+.1f}", edges.slow.counts - edges.motor_counts),
                            told(edges.slow), told(edges.fast), told(weighed),
                            fmt::format("{:.2f} ({:.2f})", 1e3 * beyond_min_m, 1e3 * room_min_m),
                            fmt::format("{:.2f} ({:.2f})", 1e3 * beyond_max_m, 1e3 * room_max_m),
                            fmt::format("{:+.0f}", approaches[1].shift_counts)});
      context.tell(static_cast<double>(i + 1) / settings.repeats);
    }
    return judged(context, belief, all, doubted, known, std::move(table));
  }

 private:
  static std::string told(const Distance& distance) {
    return fmt::format("{:.1f} +- {:.1f}", distance.counts, distance.standard_error_counts);
  }

  static identify::Recording play(const ProcedureContext& context,
                                  const SafeRangeSettings& settings, const Track& track,
                                  int number) {
    Conversation talk{.name = fmt::format("EXP-P-5-{}-{}", core::name_of(context.axis), number)};
    talk.start_m = middle_of_tracks(context.machine);
    talk.start_m[context.axis] = track.min_m + settings.near_m;
    talk.steps = declare_position(talk, context.machine);
    const auto name = core::name_of(context.axis);
    talk.steps.push_back(move(fmt::format("poscalib {} --end min", name), 200));
    // From where homing ends, just inside the soft limit, to short of the other one.
    talk.steps.push_back(move(
        fmt::format("run -trapez {} --distance {:.4f}m --speed {:.3f}m/s", name,
                    track.length_m() - settings.near_m,
                    0.5 * context.machine.configuration().axes[context.axis].speed_limit_m_per_s),
        200));
    talk.steps.push_back(move(fmt::format("poscalib {} --end max", name), 200));
    talk.limit_s = 600;
    // Each from further back than the one before, so that a carriage that sticks and slips meets a
    // switch in another moment of its slip.
    auto configuration = studied_configuration(context);
    auto& back_off_m = configuration.axes[context.axis].homing.back_off_m;
    back_off_m *= 1 + kFurther * number;
    return context.machine.play(talk, configuration);
  }

  static ProcedureOutcome judged(const ProcedureContext& context,
                                 const bbmc::AxisConfiguration& belief,
                                 const std::vector<Distance>& all,
                                 const std::vector<double>& doubted, bool identified,
                                 ResultTable table) {
    const auto n = static_cast<double>(all.size());
    double mean = 0;
    for (const auto& each : all) {
      mean += each.counts / n;
    }
    double square = kEdge_counts * kEdge_counts;
    for (const auto& each : all) {
      square += (each.counts - mean) * (each.counts - mean) / (n - 1) / n +
                each.alike_counts * each.alike_counts / (n * n);
    }
    for (const double each : doubted) {
      square += each * each;
    }
    // A transmission that the model does not describe, one with play: of both edges.
    if (const auto* left = context.find(kLeftByPulses); left != nullptr && left->value > kRight) {
      square += 2 * left->value * left->value;
    }
    const double m = belief.m_per_count();
    ProcedureOutcome outcome;
    const auto add = [&](const char* quantity, double value) {
      outcome.estimates.push_back(identify::with_standard_error(
          {.quantity = quantity,
           .axis = std::string(core::name_of(context.axis)),
           .value = value,
           .unit = "m",
           .rests_on = fmt::format(
               "{} approaches by the controller's homing, less the transmission's stretch by "
               "the torque at the edge with {}; the min switch is the origin",
               all.size(),
               identified ? "the transmission and friction of EXP-OL-2"
                          : "a transmission and friction that were only believed"),
           .procedure = "EXP-P-5"},
          std::sqrt(square) * m));
    };
    add("hall_distance_m", mean * m);
    add("hall_max_m", static_cast<double>(belief.ends.hall_min_count) * m + mean * m);
    outcome.tables.push_back(std::move(table));
    return outcome;
  }

  static constexpr double kFurther = 0.073;  // of the way back, no part of a slip's length
  static constexpr std::size_t kSeek_rows = 100;
  static constexpr double kRight = 0.41;  // counts: two roundings
  // A switch's own delay, the row in which it closed, the encoder's phase: of both edges.
  static constexpr double kEdge_counts = 2;
};

}  // namespace

std::unique_ptr<Procedure> safe_range() {
  return std::make_unique<SafeRange>();
}

}  // namespace towbench::study::procedures
