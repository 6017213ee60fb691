#include "study/diagnose/next_experiment.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "study/prediction/axis.h"

namespace towbench::study::diagnose {
namespace {

using Eigen::Index;

constexpr double kTwiceAsGood = 1.5;
constexpr double kDuration_s = 12;
constexpr double kRate_Hz = 500;
constexpr double kLoop_Hz = 6;  // of the controller that follows a trial
constexpr int kTrialRounds = 4;
constexpr double kLoggedAcceleration = 3;  // times what rms input gives the mass

// What a log of the trial would hold, made with `model`: exact places, input by a stiff loop.
Run driven(const Scene& like, const Model& model, const TrialMotion& motion) {
  Run run;
  run.period_s = 1 / kRate_Hz;
  run.reference_m = motion.positions_m(kDuration_s, run.period_s);
  run.position_m = run.reference_m;
  run.input_N = Eigen::VectorXd::Zero(run.reference_m.size());
  const double w = 2 * std::numbers::pi * kLoop_Hz;
  const double mass = model.parameters[Key::kMass];
  Scene scene(run, *like.stated);
  scene.stroke_min_m = like.stroke_min_m;
  scene.stroke_max_m = like.stroke_max_m;
  scene.session_length_s = kDuration_s;
  Axis axis(model.parameters, scene);
  axis.place(run.reference_m[0], 0);
  double impulse = 0;
  for (Index k = 0; k < run.size(); ++k) {
    run.position_m[k] = axis.reading_m();
    const double ahead = k + 1 < run.size() ? run.reference_m[k + 1] : run.reference_m[k];
    const double speed = (ahead - run.reference_m[k]) / run.period_s;
    run.input_N[k] = mass * (w * w * (run.reference_m[k] - run.position_m[k]) +
                             2 * w * (speed - axis.speed_m_per_s()));
    scene.impulse_Ns[k] = impulse;
    scene.set_means(k);
    impulse += run.input_N[k] * run.period_s;
    axis.step(k);
  }
  return run;
}

}  // namespace

std::optional<NextExperiment> separate(const Search& search, const Model& cause, const State& other,
                                       const std::string& alternative) {
  const double to_force = cause.parameters[Key::kMass] * search.bandwidth * search.bandwidth;
  const auto rms = [](const Eigen::VectorXd& e) {
    return e.norm() / std::sqrt(static_cast<double>(e.size()));
  };
  NextExperiment best{
      {},
      alternative,
      0,
      to_force * std::sqrt(std::max(0.0, std::pow(rms(other.fitted.e), 2) -
                                             std::pow(rms(search.final.fitted.e), 2)))};
  const double brisk =
      kLoggedAcceleration * search.context.input_rms_N / cause.parameters[Key::kMass];
  std::vector<FreeParameter> free;
  for (const FreeParameter& f : other.free) {
    if (f.of == FreeParameter::Of::kAll) free.push_back(f);
  }
  NominalModel stated = search.context.stated;
  stated.input_is_held = true;
  Run blank;
  blank.period_s = 1 / kRate_Hz;
  blank.position_m = blank.input_N = Eigen::VectorXd::Zero(2);
  Scene like(blank, stated);
  like.stroke_min_m = search.context.stroke_min_m;
  like.stroke_max_m = search.context.stroke_min_m + search.context.stroke_m;
  for (const TrialMotion& motion : motion_menu(search.context, brisk)) {
    const std::vector<Run> runs{driven(like, {cause.parameters, {}}, motion)};
    const Data data = make_data(runs, stated);
    const Fitted fitted =
        fit_model(data, search.context, {other.fitted.model.parameters, std::vector<OfRun>(1)},
                  free, search.bandwidth, cut(data, search.bandwidth), kTrialRounds);
    const double left = to_force * rms(fitted.e);
    if (std::isfinite(left) && left > best.separation_N) {
      best.separation_N = left;
      best.motion = motion;
    }
  }
  const double noise = to_force * 0.3 * search.context.resolution_m;
  const bool helps = best.separation_N > kTwiceAsGood * std::max(best.in_this_data_N, noise);
  return helps ? std::optional<NextExperiment>(best) : std::nullopt;
}

}  // namespace towbench::study::diagnose
