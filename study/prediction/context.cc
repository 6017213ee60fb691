#include "study/prediction/context.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

namespace towbench::study::diagnose {
namespace {

constexpr double kNone = std::numeric_limits<double>::infinity();

double least_of(const Eigen::VectorXd& values) {
  return values.size() > 0 ? values.minCoeff() : kNone;
}

constexpr double kGoesBack = 0.02;  // of its way, at most

// How far a run goes back in one direction, of its way.
double goes_back(const Run& run, double direction) {
  double farthest_m = direction * run.position_m[0];
  double back_m = 0;
  for (const double position_m : run.position_m) {
    farthest_m = std::max(farthest_m, direction * position_m);
    back_m = std::max(back_m, farthest_m - direction * position_m);
  }
  return back_m / std::max(1e-12, run.position_m.maxCoeff() - run.position_m.minCoeff());
}

}  // namespace

double one_way(const Data& data) {
  const auto all_go = [&](double direction) {
    return std::all_of(data.scenes.begin(), data.scenes.end(), [&](const Scene& scene) {
      return goes_back(*scene.run, direction) < kGoesBack;
    });
  };
  if (all_go(1)) return 1;
  return all_go(-1) ? -1 : 0;
}

Context make_context(const NominalModel& stated, const Data& data) {
  Context c;
  c.stated = stated;
  double energy = 0;
  double coldest_K = kNone;
  double warmest_K = -kNone;
  for (const Scene& scene : data.scenes) {
    const Run& run = *scene.run;
    energy += run.input_N.squaredNorm();
    c.input_max_N = std::max(c.input_max_N, run.input_N.cwiseAbs().maxCoeff());
    c.period_s = std::max(c.period_s, run.period_s);
    c.duration_s += run.period_s * static_cast<double>(run.size());
    c.resolution_m = std::max(c.resolution_m, run.resolution_m);
    c.others.resize(std::max(c.others.size(), scene.others.size()));
    for (std::size_t i = 0; i < scene.others.size(); ++i) {
      c.others[i].moves |= scene.others[i].m_per_s.cwiseAbs().maxCoeff() > 0;
      c.others[i].rotary = run.others[i].rotary;
    }
    coldest_K = std::min(coldest_K, least_of(run.temperature_K));
    warmest_K = std::max(warmest_K, -least_of(-run.temperature_K));
  }
  c.temperature_range_K = std::max(0.0, warmest_K - coldest_K);
  c.input_rms_N = std::sqrt(energy / static_cast<double>(data.samples()));
  c.top_speed_m_per_s = data.scenes.front().top_speed_m_per_s;
  c.mass_least_kg = stated.mass_kg / kMassOff;
  c.mass_most_kg = stated.mass_kg * kMassOff;
  c.one_way = one_way(data);
  c.stroke_min_m = data.scenes.front().stroke_min_m;
  c.stroke_m = data.scenes.front().stroke_max_m - data.scenes.front().stroke_min_m;
  return c;
}

Parameters parameters_of(const NominalModel& stated) {
  Parameters p;
  for (std::size_t key = 0; key < kKeys; ++key) {
    p[static_cast<Key>(key)] = stated.terms[static_cast<Key>(key)];
  }
  p[Key::kMass] = stated.mass_kg;
  p[Key::kViscous] = stated.viscous_N_s_per_m;
  p[Key::kCoulomb] = stated.coulomb_N;
  p[Key::kBias] = stated.bias_N;
  if (stated.breakaway_excess_N != 0) {
    p[Key::kStribeck] = stated.breakaway_excess_N;
    p[Key::kStribeckSpeed] = std::max(1e-9, stated.stribeck_speed_m_per_s);
  }
  if (stated.elastic()) {
    p[Key::kMotorMass] = stated.transmission.motor_kg;
    p[Key::kStiffness] = stated.transmission.stiffness_N_per_m;
    p[Key::kDamping] = stated.transmission.damping_N_s_per_m;
    p[Key::kPlay] = stated.transmission.play_m;
    p[Key::kLoadShare] = stated.transmission.load_share;
  }
  return p;
}

}  // namespace towbench::study::diagnose
