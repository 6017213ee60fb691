#include "study/prediction/axis.h"

#include <algorithm>
#include <cmath>
#include <initializer_list>
#include <numbers>

namespace towbench::study::diagnose {
namespace {

constexpr double kTurn = 2 * std::numbers::pi;
constexpr double kLeastOfMass = 0.1;  // of this axis, whatever the others add
constexpr double kStepsPerMode = 25;  // substeps in a period of the transmission's mode

double sign(double x) {
  return x > 0 ? 1.0 : x < 0 ? -1.0 : 0.0;
}

// exp(-x); where that is nothing, the library's function takes long to say so.
double faded(double x) {
  constexpr double kNothing = 40;
  return x > kNothing ? 0.0 : std::exp(-x);
}

double wave(double cosine, double sine, double turns) {
  const double angle = kTurn * turns;
  if (sine == 0) return cosine * std::cos(angle);
  if (cosine == 0) return sine * std::sin(angle);
  return cosine * std::cos(angle) + sine * std::sin(angle);
}

bool any(const Parameters& p, std::initializer_list<Key> keys) {
  return std::any_of(keys.begin(), keys.end(), [&](Key key) { return p[key] != 0; });
}

}  // namespace

Axis::Axis(const Parameters& parameters, const Scene& scene)
    : p_(parameters),
      scene_(scene),
      bristles_(parameters),
      middle_m_(0.5 * (scene.stroke_min_m + scene.stroke_max_m)),
      place_(parameters, scene),
      stated_force_(!scene.stated->force_at_m.empty() || scene.stated->cable_N_per_m != 0),
      two_(parameters[Key::kMotorMass] > 0),
      drive_(any(p_, {Key::kDeadband, Key::kClipShare, Key::kStallShare, Key::kLag,
                      Key::kOutOfRoundPerMetre})),
      on_motor_(any(p_, {Key::kRipplePerMetre, Key::kWheelPerMetre}) || scene.extra_N.size() > 0),
      on_load_(place_.have_force() || stated_force_ || has_others(p_) ||
               any(p_, {Key::kViscousAsymmetry, Key::kDrag, Key::kCubic, Key::kCable,
                        Key::kGravityCosine, Key::kGravitySine, Key::kPeriodicHertz,
                        Key::kTemperatureViscous})),
      dry_(any(p_, {Key::kCoulombAsymmetry, Key::kStribeck, Key::kRolloff, Key::kPresliding,
                    Key::kWarming, Key::kBreakaway, Key::kWorkWarming, Key::kTemperatureDry})),
      others_(has_others(p_)),
      temperature_(any(p_, {Key::kTemperatureDry, Key::kTemperatureViscous}) &&
                   scene.run->temperature_K.size() > 0) {
  const double load = p_[Key::kMass] - p_[Key::kMotorMass];
  substeps_ = scene.substeps;
  if (two_) {
    const double reduced = load * p_[Key::kMotorMass] / p_[Key::kMass];
    const double longest =
        std::min(kLongestStep_s, kTurn * std::sqrt(reduced / p_[Key::kStiffness]) / kStepsPerMode);
    substeps_ = std::max(1, static_cast<int>(std::ceil(scene.run->period_s / longest - 1e-9)));
  }
  h_ = scene.run->period_s / substeps_;
  if (two_) {
    motor_slides_ = sliding(p_[Key::kMotorMass], 1 - p_[Key::kLoadShare], false);
    load_slides_ = sliding(load, p_[Key::kLoadShare], true);
  } else {
    motor_slides_ = sliding(p_[Key::kMass], 1, true);
  }
  if (p_[Key::kWarming] != 0) {
    warm_end_ = 1 - std::exp(-scene.session_length_s / p_[Key::kWarmingTime]);
  }
}

Axis::Sliding Axis::sliding(double mass_kg, double share, bool load) const {
  const double per_newton = h_ / mass_kg;
  return {per_newton, 1 / (1 + per_newton * share * p_[Key::kViscous]), share, load};
}

void Axis::place(double position_m, double speed_m_per_s) {
  const double counted = 1 - p_[Key::kCountLoss];
  motor_ = {position_m / counted, speed_m_per_s / counted, speed_m_per_s == 0};
  load_ = motor_;
  if (two_) load_.x += wheel_at(p_, motor_.x).ahead_m;
  lagged_N_ = scene_.run->input_N[0];
  bristles_.place(motor_.x, motor_.v);
}

// `read_m` of what is read; lost counts make no correction faster.
void Axis::correct(const Correction& by, double read_m) {
  const double off_m = read_m / (1 - p_[Key::kCountLoss]);
  motor_.x += by.motor_m * off_m;
  bristles_.correct(by.motor_m * off_m);
  motor_.v += by.motor_m_per_s * off_m;
  load_.x += by.load_m * off_m;
  load_.v += by.load_m_per_s * off_m;
}

double Axis::reading_m() const {
  const double x = (1 - p_[Key::kCountLoss]) * motor_.x;
  return p_[Key::kReadPerMetre] == 0
             ? x
             : x + wave(p_[Key::kReadCosine], p_[Key::kReadSine],
                        p_[Key::kReadPerMetre] * motor_.x + p_[Key::kReadTurns]);
}

void Axis::look_up(Eigen::Index k) {
  if (temperature_) warmer_K_ = scene_.run->temperature_K[k] - scene_.mean_temperature_K;
  if (!others_) return;
  of_others_ = of_others(p_, scene_, k, motor_.x);
  const double own = two_ ? p_[Key::kMass] - p_[Key::kMotorMass] : p_[Key::kMass];
  const double mass = std::max(kLeastOfMass * own, own + of_others_.mass_kg);
  (two_ ? load_slides_ : motor_slides_) = sliding(mass, two_ ? p_[Key::kLoadShare] : 1, true);
}

void Axis::step(Eigen::Index k) {
  look_up(k);
  const bool precomputed = p_[Key::kDelay] == 0 && substeps_ == scene_.substeps;
  for (int i = 0; i < substeps_; ++i) {
    const double t_s = static_cast<double>(k) * scene_.run->period_s + i * h_;
    const double mean_N = precomputed ? scene_.mean_N[k * substeps_ + i]
                                      : scene_.mean_input_N(t_s - p_[Key::kDelay], h_);
    if (two_) {
      substep<true>(t_s, mean_N, k);
    } else {
      substep<false>(t_s, mean_N, k);
    }
  }
}

double Axis::driven_N(double input_N) {
  double drive = (1 - p_[Key::kGainLoss]) * input_N;
  if (!drive_) {
    return drive;
  }
  if (p_[Key::kDeadband] > 0) {
    drive = sign(drive) * std::max(0.0, std::abs(drive) - p_[Key::kDeadband]);
  }
  if (p_[Key::kClipShare] != 0) {
    drive -=
        p_[Key::kClipShare] * sign(drive) * std::max(0.0, std::abs(drive) - p_[Key::kClipLevel]);
  }
  if (p_[Key::kStallShare] != 0) {
    const double along = motor_.v * sign(drive) / p_[Key::kStallSpeed];
    const double level = p_[Key::kStallLevel] * std::max(0.0, 1 - along);
    drive -= p_[Key::kStallShare] * sign(drive) * std::max(0.0, std::abs(drive) - level);
  }
  if (p_[Key::kLag] > 0) {
    const double gone = 1 - std::exp(-h_ / p_[Key::kLag]);
    const double mean = drive + (lagged_N_ - drive) * gone * p_[Key::kLag] / h_;
    lagged_N_ += (drive - lagged_N_) * gone;
    drive = mean;
  }
  if (p_[Key::kOutOfRoundPerMetre] != 0) {
    drive *= 1 - wave(p_[Key::kOutOfRoundCosine], p_[Key::kOutOfRoundSine],
                      p_[Key::kOutOfRoundPerMetre] * motor_.x + p_[Key::kOutOfRoundTurns]);
  }
  return drive;
}

double Axis::on_motor_N(Eigen::Index k) const {
  const double x = motor_.x;
  double force = 0;
  if (!on_motor_) {
    return force;
  }
  if (p_[Key::kRipplePerMetre] != 0) {
    force += wave(p_[Key::kRippleCosine], p_[Key::kRippleSine],
                  p_[Key::kRipplePerMetre] * x + p_[Key::kRippleTurns]);
  }
  if (p_[Key::kWheelPerMetre] != 0 && !two_) {
    force += rigid_wheel_N(p_, motor_.x, motor_.v, acceleration_);
  }
  if (scene_.extra_N.size() > 0) {
    force += scene_.extra_N[k];
  }
  return force;
}

double Axis::on_load_N(const Body& body, double t_s) const {
  const double x = body.x;
  const double v = body.v;
  if (!on_load_) {
    return p_[Key::kBias];
  }
  const double speed = std::abs(v);
  double force = of_others_.force_N + p_[Key::kBias] + p_[Key::kViscousAsymmetry] * speed +
                 p_[Key::kDrag] * v * speed + p_[Key::kCubic] * v * v * v +
                 p_[Key::kCable] * (x - middle_m_) +
                 (of_others_.mass_kg_per_s - p_[Key::kTemperatureViscous] * warmer_K_) * v;
  if (stated_force_) {
    force += stated_force_N(*scene_.stated, x);
  }
  if (place_.have_force()) {
    force += place_.force_N(v);
  }
  if (p_[Key::kPeriodicHertz] != 0) {
    force += wave(p_[Key::kPeriodicCosine], p_[Key::kPeriodicSine],
                  p_[Key::kPeriodicHertz] * t_s + p_[Key::kPeriodicTurns]);
  }
  if (p_[Key::kGravitySine] != 0 || p_[Key::kGravityCosine] != 0) {
    force += p_[Key::kGravityCosine] * std::cos(x) + p_[Key::kGravitySine] * std::sin(x);
  }
  return force;
}

double Axis::shared_dry_N(const Body& body, double direction, double t_s) const {
  if (!dry_) {
    return p_[Key::kCoulomb];
  }
  const double speed = std::abs(body.v);
  double asymmetry_N = p_[Key::kCoulombAsymmetry] * direction;
  double level = p_[Key::kCoulomb] - p_[Key::kTemperatureDry] * warmer_K_;
  if (p_[Key::kStribeck] != 0) {
    const double s = speed / p_[Key::kStribeckSpeed];
    const double fade = scene_.stated->stribeck_is_lorentz ? 1 / (1 + s * s) : faded(s * s);
    level += p_[Key::kStribeck] * fade;
    asymmetry_N *= 1 - fade;  // break-away is alike in both directions
  }
  level += asymmetry_N;
  if (p_[Key::kRolloff] != 0) {
    level -= p_[Key::kRolloff] * faded(speed / p_[Key::kRolloffSpeed]);
  }
  level -= bristles_.level_N();  // that part is in slide()
  if (p_[Key::kWarming] != 0) {
    const double t = scene_.session_start_s + t_s;
    level -= p_[Key::kWarming] * (1 - std::exp(-t / p_[Key::kWarmingTime])) / warm_end_;
  }
  if (p_[Key::kBreakaway] != 0 && (body.stands || body.leaves)) {
    const double s = speed / p_[Key::kBreakawaySpeed];
    level += p_[Key::kBreakaway] * faded(s * s);
  }
  return level * (1 - p_[Key::kWorkWarming] * warmth_);
}

double Axis::load_dry_N(const Body& body, double drive_N) const {
  double level = p_[Key::kLoadFriction] * std::abs(drive_N);
  if (place_.have_friction()) {
    level += place_.friction_N();
  }
  if (!scene_.stated->friction_at_m.empty()) {
    level += stated_friction_N(*scene_.stated, body.x);
  }
  return level;
}

void Axis::slide(Body& body, const Sliding& how, double force_N, double drive_N, double t_s) const {
  double free = (body.v + how.per_newton * force_N) * how.left;
  if (bristles_.level_N() > 0) {
    const double per_newton = how.left * how.per_newton * how.share;
    free =
        (free - per_newton * bristles_.grip_N()) / (1 + per_newton * bristles_.damping_N_s_per_m());
  }
  const double direction = body.v != 0 && !body.stands ? sign(body.v) : sign(free);
  const double dry =
      how.share * shared_dry_N(body, direction, t_s) + (how.load ? load_dry_N(body, drive_N) : 0);
  const double loss = how.per_newton * std::max(0.0, dry);
  const double before = std::abs(body.v);
  body.stands = std::abs(free) <= loss;
  body.v = body.stands ? 0.0 : free - std::copysign(loss, free);
  body.leaves = std::abs(body.v) >= before;
}

// Forces act in the middle of the step's way (leapfrog): second order, and no phase of its own.
template <bool two>
void Axis::substep(double t_s, double mean_N, Eigen::Index k) {
  const double drive = driven_N(mean_N);
  const double before = motor_.v;
  motor_.x += 0.5 * h_ * motor_.v;
  if constexpr (two) load_.x += 0.5 * h_ * load_.v;
  if (place_.any()) place_.go_to((two ? load_ : motor_).x);
  const double on_motor = drive - on_motor_N(k);
  if constexpr (two) {
    const Wheel wheel = wheel_at(p_, motor_.x);
    const double transmission = transmission_N(wheel);
    slide(motor_, motor_slides_, on_motor - (1 + wheel.excess) * transmission, drive, t_s);
    slide(load_, load_slides_, transmission - on_load_N(load_, t_s), transmission, t_s);
  } else {
    slide(motor_, motor_slides_, on_motor - on_load_N(motor_, t_s), drive, t_s);
  }
  if (p_[Key::kWheelPerMetre] != 0) acceleration_ = (motor_.v - before) / h_;
  motor_.x += 0.5 * h_ * motor_.v;
  if constexpr (two) load_.x += 0.5 * h_ * load_.v;
  if (p_[Key::kWorkWarming] != 0) {
    // What friction dissipates, beside cold Coulomb friction at top speed.
    const double power =
        std::abs(motor_.v) / scene_.top_speed_m_per_s * (1 - p_[Key::kWorkWarming] * warmth_);
    warmth_ += h_ / p_[Key::kWorkWarmingTime] * (power - warmth_);
  }
  if (bristles_.level_N() > 0) {
    bristles_.go_to(motor_.x);
  }
}

double Axis::transmission_N(const Wheel& wheel) const {
  const double half = 0.5 * p_[Key::kPlay];
  const double stretch = motor_.x + wheel.ahead_m - load_.x;
  const double past = std::abs(stretch) <= half ? 0 : stretch - sign(stretch) * half;
  if (past == 0 && half > 0) {
    return 0;
  }
  const double transmission =
      p_[Key::kStiffness] * past + p_[Key::kDamping] * ((1 + wheel.excess) * motor_.v - load_.v);
  return half > 0 && transmission * past < 0 ? 0 : transmission;  // a flank pushes and never pulls
}

}  // namespace towbench::study::diagnose
