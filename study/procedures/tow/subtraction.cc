// The subtractive approach (3.1): shaft alone, then shaft and object; the rest is the object's own.
#include "study/identify/tow/paired_difference.h"
#include "study/procedures/settings.h"
#include "study/procedures/tow/feasibility.h"
#include "study/procedures/tow/straight_tow.h"
#include "study/procedures/tow/tow_procedure.h"

namespace towbench::study::procedures {
namespace {

using core::Axis;

struct SubtractionSettings {
  StraightTowSettings tows{0.15, 0.30, 0.45};

  template <typename Visitor>
  void visit(Visitor& v) {
    v.group("tows", tows, "with each load");
  }
};

class Subtraction final : public TowProcedure {
 public:
  [[nodiscard]] std::string_view id() const noexcept override { return "subtraction"; }
  [[nodiscard]] std::string_view title() const noexcept override {
    return "the object's own drag, shaft subtracted";
  }
  void check_settings(const std::filesystem::path& file) const override {
    static_cast<void>(read_settings<SubtractionSettings>(file, Axis::kY));
  }
  [[nodiscard]] Load load() const override { return {.rig = "tow-shaft-and-cylinder"}; }

  [[nodiscard]] TowOutcome run(const TowContext& context) const override {
    const auto s = read_settings<SubtractionSettings>(context.settings, Axis::kY);
    const Load shaft_only{.rig = "tow-shaft"};
    const auto both = context.loads.with(load());
    const auto shaft = context.loads.with(shaft_only);
    for (auto why : {no_force_sensor(both), not_in_water(context.loads, load()),
                     not_in_water(context.loads, shaft_only), why_not(both, s.tows)}) {
      if (!why.empty()) {
        return tow_refused(why);
      }
    }
    const auto with = tow(both, "shaft and object", s.tows);
    context.tell(0.5);
    const auto without = tow(shaft, "shaft alone", s.tows);
    for (const auto* each : {&with, &without}) {
      if (!each->trouble.empty()) {
        return tow_failed(each->trouble);
      }
    }
    std::vector<identify::DragPoint> object;
    std::vector<identify::DragPoint> alone;
    for (std::size_t k = 0; k < with.recordings.size(); ++k) {
      const auto& a = with.recordings[k];
      const auto& b = without.recordings[k];
      const auto rest = identify::paired_difference(a, a.force_N[Axis::kY], b, b.force_N[Axis::kY],
                                                    Axis::kY, -1.0, s.tows.settle_s);
      const auto own = identify::both_ways(b, b.force_N[Axis::kY], Axis::kY, -1.0, s.tows.settle_s);
      if (!rest || !own) {
        return tow_failed("a tow has no steady part both ways");
      }
      object.push_back(*rest);
      alone.push_back(*own);
    }
    TowOutcome outcome;
    outcome.estimates = identify::drag_curve(object, "object_drag_N", "y",
                                             "force sensor, both loads less the shaft alone");
    outcome.estimates.push_back(identify::to_estimate(
        identify::quadratic_drag(object), "object_drag_N_s2_per_m2", "y", "N s2/m2",
        "force sensor, shaft and object less the shaft alone, both ways"));
    outcome.estimates.push_back(identify::to_estimate(identify::quadratic_drag(alone),
                                                      "shaft_drag_N_s2_per_m2", "y", "N s2/m2",
                                                      "force sensor, the shaft alone, both ways"));
    outcome.simulated_s = both.simulated_s() + shaft.simulated_s();
    return outcome;
  }
};

}  // namespace

std::unique_ptr<TowProcedure> subtraction() {
  return std::make_unique<Subtraction>();
}

}  // namespace towbench::study::procedures
