// EXP-P-5: the safe range of motion (thesis 4.1.2): each hall switch approached below the speed
// that can be stopped before the hard end, by the controller's own homing.
//
// The min switch is the origin. Coming to the max switch the controller declares where it stands by
// its belief of the distance; by how much its count is shifted is what that belief was off.
#include <algorithm>
#include <cmath>
#include <cstdlib>

#include <fmt/format.h>

#include "harness/procedures/believed_model.h"
#include "harness/procedures/procedures.h"
#include "harness/procedures/settings.h"

namespace towbench::harness::procedures {
namespace {

struct Settings {
  int repeats = 3;
  double near_m = 0.08;

  template <typename Visitor>
  void visit(Visitor& v) {
    v.value("repeats", repeats, core::between(2, 20), "of the whole, there and back");
    v.value("near_m", near_m, core::between(0.02, 0.5), "from a soft limit, where homing begins");
  }
};

struct Range {
  double shift_counts = 0;  // of the max switch against belief
  double beyond_min_m = 0;  // furthest beyond each switch
  double beyond_max_m = 0;
  bool found = false;
};

// A jump of the reference while it stands: there the controller declared its place.
struct Declared {
  std::size_t row = 0;  // the first in the new frame
  double shift_counts = 0;
};

std::vector<Declared> declared_in(const identify::Recording& data, core::Axis axis) {
  std::vector<Declared> found;
  const auto& columns = data.axes[axis];
  for (std::size_t k = 2; k + 1 < data.rows(); ++k) {
    const double jump = columns.reference_m[k] - columns.reference_m[k - 1];
    const bool stands = columns.reference_velocity_m_per_s[k] == 0 &&
                        columns.reference_velocity_m_per_s[k - 1] == 0;
    if (stands && std::fabs(jump) > 0.4 * data.metres_per_count[axis]) {
      found.push_back({k, std::round(jump / data.metres_per_count[axis])});
    }
  }
  return found;
}

// In the frame of the min switch, which the first declaration begins and the last one ends.
Range range_of(const identify::Recording& data, core::Axis axis,
               const bbmc::AxisConfiguration& belief) {
  Range range;
  const double m = data.metres_per_count[axis];
  const double low_m = belief.position_m(belief.ends.hall_min_count);
  const double high_m = belief.position_m(belief.ends.hall_max_count);
  Declared first{};
  Declared last{.row = data.rows()};
  for (const auto& each : declared_in(data, axis)) {
    const bool at_max = data.position_m(axis, each.row) > 0.5 * (low_m + high_m);
    (at_max ? last : first) = each;
  }
  // A switch exactly where it was believed makes no jump.
  range.found = first.row < last.row;
  range.shift_counts = last.shift_counts;
  for (std::size_t k = 0; k < last.row; ++k) {
    const double x = data.position_m(axis, k) + (k < first.row ? first.shift_counts * m : 0.0);
    range.beyond_min_m = std::max(range.beyond_min_m, low_m - x);
    range.beyond_max_m = std::max(range.beyond_max_m, x - (high_m - last.shift_counts * m));
  }
  return range;
}

class SafeRange final : public Procedure {
 public:
  [[nodiscard]] std::string_view id() const noexcept override { return "EXP-P-5"; }
  [[nodiscard]] std::string_view title() const noexcept override { return "Safe range of motion"; }

  [[nodiscard]] ProcedureOutcome run(const ProcedureContext& context) const override {
    const auto settings = read_settings<Settings>(context.settings, context.axis);
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
    std::vector<double> shifts;
    ResultTable table{
        .title = "Approaches",
        .head = {"max switch against belief, counts", "furthest beyond min switch, mm (room)",
                 "beyond max switch, mm (room)"}};
    for (int i = 0; i < settings.repeats; ++i) {
      const auto data = play(context, settings, track, i);
      if (!data.trouble.empty()) {
        return ProcedureOutcome::failed(data.trouble);
      }
      const auto range = range_of(data, context.axis, belief);
      if (!range.found) {
        return ProcedureOutcome::failed("the log does not show where the max switch was declared");
      }
      if (range.beyond_min_m > room_min_m || range.beyond_max_m > room_max_m) {
        return ProcedureOutcome::failed("the approach went as far as the hard end should be");
      }
      shifts.push_back(range.shift_counts);
      table.rows.push_back(
          {fmt::format("{:+.0f}", -range.shift_counts),
           fmt::format("{:.2f} ({:.2f})", 1e3 * range.beyond_min_m, 1e3 * room_min_m),
           fmt::format("{:.2f} ({:.2f})", 1e3 * range.beyond_max_m, 1e3 * room_max_m)});
      context.tell(static_cast<double>(i + 1) / settings.repeats);
    }
    return judged(context, belief, shifts, std::move(table));
  }

 private:
  static identify::Recording play(const ProcedureContext& context, const Settings& settings,
                                  const Track& track, int number) {
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
    return context.machine.play(talk, studied_configuration(context));
  }

  static ProcedureOutcome judged(const ProcedureContext& context,
                                 const bbmc::AxisConfiguration& belief,
                                 const std::vector<double>& shifts, ResultTable table) {
    // What the stretch of the chain at each switch, which homing takes off by its belief of
    // friction (homing.h), is off by on a machine nobody knows yet: up to 15 counts were seen.
    constexpr double kLead_counts = 8;
    const auto n = static_cast<double>(shifts.size());
    double mean = 0;
    for (const double each : shifts) {
      mean += each / n;
    }
    double square = kLead_counts * kLead_counts;
    for (const double each : shifts) {
      square += (each - mean) * (each - mean) / (n - 1) / n;
    }
    const double m = belief.m_per_count();
    const double believed_m =
        static_cast<double>(belief.ends.hall_max_count - belief.ends.hall_min_count) * m;
    ProcedureOutcome outcome;
    const auto add = [&](const char* quantity, double value) {
      outcome.estimates.push_back(identify::with_deviation(
          {.quantity = quantity,
           .axis = std::string(core::name_of(context.axis)),
           .value = value,
           .unit = "m",
           .rests_on = fmt::format("{} approaches at the controller's homing speed; the min switch "
                                   "is the origin",
                                   shifts.size()),
           .procedure = "EXP-P-5"},
          std::sqrt(square) * m));
    };
    add("hall_distance_m", believed_m - mean * m);
    add("hall_max_m", belief.position_m(belief.ends.hall_max_count) - 0.5 * m - mean * m);
    outcome.tables.push_back(std::move(table));
    return outcome;
  }
};

}  // namespace

std::unique_ptr<Procedure> safe_range() {
  return std::make_unique<SafeRange>();
}

}  // namespace towbench::harness::procedures
