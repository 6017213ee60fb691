// EXP-1: drag on straight tows by the three methods of chapter 8.
#include <cmath>

#include <fmt/format.h>

#include "study/identify/tow/extended_model.h"
#include "study/identify/tow/paired_difference.h"
#include "study/procedures/settings.h"
#include "study/procedures/tow/feasibility.h"
#include "study/procedures/tow/straight_drag_settings.h"
#include "study/procedures/tow/straight_drag_tables.h"
#include "study/procedures/tow/tow_procedure.h"

namespace towbench::study::procedures {
namespace {

using core::Axis;
using identify::DragPoint;
using identify::Recording;

constexpr const char* kDragUnit = "N s2/m2";
constexpr const char* kRepeats =
    "the duty of a steady tow repeats itself: its scatter does not show the error of its mean";
constexpr const char* kBlind =
    "the model's bias exceeds the noise: friction by place reads as drag";

// Measured points of one method, and the coefficient they give.
struct Method {
  std::string name;  // of its quantities
  std::string rests_on;
  std::string no_interval{};             // why its noise says nothing of its error
  std::string no_interval_at_a_speed{};  // nor of one speed's
  std::vector<DragPoint> points{};
  bool whole = true;  // no point was missing
  bool weighted = true;

  void add(const std::optional<DragPoint>& point) {
    if (point) {
      points.push_back(*point);
    }
    whole = whole && point.has_value();
  }
  [[nodiscard]] identify::UncertainMean coefficient() const {
    return weighted ? identify::quadratic_drag(points)
                    : identify::quadratic_drag_unweighted(points);
  }
};

class Exp1 {
 public:
  Exp1(const TowContext& context, Load wet)
      : context_(context),
        settings_(read_settings<Exp1Settings>(context.settings, Axis::kY)),
        dry_(context.loads.with({})),
        wet_(context.loads.with(wet)),
        load_(std::move(wet)) {}

  TowOutcome run() {
    if (const auto why = why_it_cannot_be_done(); !why.empty()) {
      return tow_refused(why);
    }
    if (const auto trouble = measure(); !trouble.empty()) {
      return tow_failed(trouble);
    }
    return estimate();
  }

 private:
  [[nodiscard]] std::string why_it_cannot_be_done() const {
    const auto& ident = settings_.identification;
    for (auto why :
         {no_force_sensor(wet_), not_in_water(context_.loads, load_), why_not(wet_, settings_.tows),
          why_not(dry_, Axis::kY, settings_.weigh), why_not(dry_, ident.near),
          why_not(dry_, ident.middle), why_not(dry_, ident.survey)}) {
      if (!why.empty()) {
        return why;
      }
    }
    return {};
  }

  std::string measure() {
    const auto weighed = weigh_drive(dry_, Axis::kY, settings_.weigh);
    scale_ = weighed.scale;
    if (!weighed.trouble.empty()) {
      return weighed.trouble;
    }
    context_.tell(0.1);
    const auto& ident = settings_.identification;
    double done = 0.1;
    struct Set {
      std::vector<Recording>* into;
      const Machine* machine;
      const char* name;
      const StraightTowSettings* settings;
    };
    for (const auto& set : {Set{&out_, &dry_, "out of the water", &settings_.tows},
                            Set{&in_, &wet_, "in the water", &settings_.tows},
                            Set{&near_, &dry_, "identification, near end", &ident.near},
                            Set{&middle_, &dry_, "identification, mid tank", &ident.middle},
                            Set{&survey_, &dry_, "survey", &ident.survey}}) {
      auto tows = tow(*set.machine, set.name, *set.settings);
      if (!tows.trouble.empty()) {
        return tows.trouble;
      }
      *set.into = std::move(tows.recordings);
      done += 0.17;
      context_.tell(done);
    }
    return {};
  }

  TowOutcome estimate() {
    const auto rigid_near = model_of(near_, settings_.identification.near);
    const auto rigid_middle = model_of(middle_, settings_.identification.middle);
    const auto extended = extended_model();
    if (!rigid_near || !rigid_middle || !extended) {
      return tow_failed("too few steady tows to identify a model from");
    }
    std::vector<Method> methods{
        {"fsm", "force sensor in the water less out of it, both ways; no belief about the drive"},
        {"mcd", "duty in the water less out of it (8.5), both ways, scaled by a known weight", "",
         kRepeats},
        {"mbdp_near", "(8.6), rigid model of tows at the near end", kBlind},
        {"mbdp_middle", "(8.6), rigid model of tows in mid tank", kBlind},
        {"mbdp", "(8.6), model with friction by place, from tows in air", "", kRepeats}};
    methods[2].weighted = false;
    methods[3].weighted = false;
    for (std::size_t k = 0; k < in_.size(); ++k) {
      const auto& in = in_[k];
      const auto& out = out_[k];
      const double settle = settings_.tows.settle_s;
      const double scale = scale_.force_per_duty_N;
      // The sensor reads what pulls at the load: the negative of what brakes it.
      methods[0].add(identify::paired_difference(in, in.force_N[Axis::kY], out,
                                                 out.force_N[Axis::kY], Axis::kY, -1.0, settle));
      methods[1].add(identify::paired_difference(in, in.axes[Axis::kY].duty_pct, out,
                                                 out.axes[Axis::kY].duty_pct, Axis::kY, scale,
                                                 settle));
      methods[2].add(identify::predicted_drag(in, Axis::kY, scale, *rigid_near, settle));
      methods[3].add(identify::predicted_drag(in, Axis::kY, scale, *rigid_middle, settle));
      methods[4].add(identify::predicted_drag(in, Axis::kY, scale, *extended, settle));
    }
    return told(methods, *rigid_near, *rigid_middle, *extended);
  }

  [[nodiscard]] std::optional<identify::RigidModel> model_of(
      const std::vector<Recording>& tows, const StraightTowSettings& settings) const {
    return identify::rigid_model(tows, Axis::kY, scale_.force_per_duty_N, settings.settle_s);
  }

  [[nodiscard]] std::optional<identify::ExtendedModel> extended_model() const {
    const auto& survey = settings_.identification.survey;
    return identify::ExtendedModel::fit(
        survey_, Axis::kY, scale_.force_per_duty_N, survey.settle_s,
        {.from_m = survey.start_m, .to_m = survey.start_m + survey.distance_m});
  }

  TowOutcome told(const std::vector<Method>& methods, const identify::RigidModel& near,
                  const identify::RigidModel& middle, const identify::ExtendedModel& extended) {
    TowOutcome outcome;
    outcome.estimates.push_back(identify::withheld(scale_estimate(scale_, wet_), kRepeats));
    Figure curves{.title = "Drag against speed, three methods",
                  .x_label = "speed, m/s",
                  .y_label = "drag, N",
                  .caption = "Fig. 8.2 of the thesis."};
    for (const auto& method : methods) {
      if (!method.whole) {
        return tow_failed(method.name + ": a tow has no steady part both ways");
      }
      auto coefficient = method.coefficient();
      if (method.name != "fsm") {
        // The drive's scale is common to all points of a method.
        coefficient =
            identify::doubted(coefficient, scale_.standard_error_N / scale_.force_per_duty_N,
                              scale_.degrees_of_freedom);
      }
      auto found =
          identify::drag_curve(method.points, method.name + "_drag_N", "y", method.rests_on);
      if (!method.no_interval_at_a_speed.empty()) {
        for (auto& each : found) {
          each = identify::withheld(each, method.no_interval_at_a_speed);
        }
      }
      found.push_back(identify::to_estimate(coefficient, method.name + "_drag_N_s2_per_m2", "y",
                                            kDragUnit, method.rests_on));
      for (auto& each : found) {
        outcome.estimates.push_back(
            method.no_interval.empty() ? each : identify::withheld(each, method.no_interval));
      }
      curves.curves.push_back(curve_of(method.name, method.points));
    }
    outcome.figures = {std::move(curves), friction_figure(near, middle, extended)};
    std::vector<identify::TowStretch> towed;
    for (const auto& in : in_) {
      const auto more = identify::stretches(in, Axis::kY, settings_.tows.settle_s);
      towed.insert(towed.end(), more.begin(), more.end());
    }
    outcome.blind = {{"mbdp_near_drag_N_s2_per_m2", near.stretches, towed},
                     {"mbdp_middle_drag_N_s2_per_m2", middle.stretches, towed}};
    outcome.tables = {model_table(near, middle, wet_), tracking_table(out_, in_),
                      drag_table(outcome.estimates)};
    outcome.simulated_s = dry_.simulated_s() + wet_.simulated_s();
    return outcome;
  }

  const TowContext& context_;
  Exp1Settings settings_;
  Machine dry_;
  Machine wet_;
  Load load_;
  identify::DriveScale scale_;
  std::vector<Recording> out_;
  std::vector<Recording> in_;
  std::vector<Recording> near_;
  std::vector<Recording> middle_;
  std::vector<Recording> survey_;
};

class StraightDrag final : public TowProcedure {
 public:
  [[nodiscard]] std::string_view id() const noexcept override { return "EXP-1"; }
  [[nodiscard]] std::string_view title() const noexcept override {
    return "drag on straight tows, three methods";
  }
  void check_settings(const std::filesystem::path& file) const override {
    static_cast<void>(read_settings<Exp1Settings>(file, Axis::kY));
  }
  [[nodiscard]] Load load() const override { return {.rig = "tow-cylinder"}; }
  [[nodiscard]] TowOutcome run(const TowContext& context) const override {
    return Exp1(context, load()).run();
  }
};

}  // namespace

std::unique_ptr<TowProcedure> straight_drag() {
  return std::make_unique<StraightDrag>();
}

}  // namespace towbench::study::procedures
