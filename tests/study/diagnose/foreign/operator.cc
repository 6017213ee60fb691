#include "tests/study/diagnose/foreign/operator.h"

#include <algorithm>
#include <cmath>

namespace towbench::tests::foreign {
namespace {

// PID with feedforward of what the file states, and no integration beyond the limit.
class PositionLoop {
 public:
  PositionLoop(const Machine& machine, const Loop& loop)
      : m_(machine),
        loop_(loop),
        w_(kTurn * loop.bandwidth_Hz),
        speed_(machine.period_s, std::max(2 * machine.period_s, 1 / (6 * w_))) {}

  // At each sample, also when somebody else drives.
  void observe(double reading_m) { rate_ = speed_.update(reading_m); }
  double force_N(const Wanted& wanted, double reading_m) {
    const double error = wanted.x_m - reading_m;
    const double rate = wanted.v_m_per_s - rate_;
    const double ahead_N = m_.mass_kg * wanted.a_m_per_s2 +
                           m_.viscous_N_s_per_m * wanted.v_m_per_s +
                           m_.coulomb_N * direction(wanted.v_m_per_s);
    const double force =
        m_.mass_kg * w_ * (w_ * error + 2 * loop_.damping * rate) + loop_.feedforward * ahead_N;
    const double wound = sum_ + m_.period_s * loop_.integral * m_.mass_kg * w_ * w_ * w_ * error;
    if (std::abs(force + wound) < m_.limit_N() || std::abs(wound) < std::abs(sum_)) {
      sum_ = wound;
    }
    return force + sum_;
  }
  void forget() { sum_ = 0; }

 private:
  const Machine& m_;
  Loop loop_;
  double w_;
  SpeedEstimate speed_;
  double rate_ = 0;
  double sum_ = 0;
};

class Follower : public Operator {
 public:
  Follower(const RunPlan& run, const Machine& machine, const Loop& loop)
      : dice_(run.seed),
        way_(draw_way(run.motion, machine, run.duration_s, dice_)),
        loop_(machine, loop) {}
  Command command(double t_s, double reading_m) override {
    const Wanted wanted = way_.at(t_s);
    loop_.observe(reading_m);
    return {loop_.force_N(wanted, reading_m), wanted.x_m};
  }
  [[nodiscard]] double start_m() const override { return way_.at(0).x_m; }

 protected:
  Dice dice_;
  Way way_;
  PositionLoop loop_;
};

// A random binary force over a loop that only keeps the axis on its rails.
class Prbs : public Follower {
 public:
  Prbs(const RunPlan& run, const Machine& machine, Loop loop)
      : Follower(run, machine, softened(loop)),
        size_N_(machine.coulomb_N + 0.6 * machine.inertial_N()),
        bit_s_(dice_.between(0.04, 0.2)) {}
  Command command(double t_s, double reading_m) override {
    if (t_s >= next_s_) {
      sign_ = dice_.sign();
      next_s_ += bit_s_;
    }
    Command command = Follower::command(t_s, reading_m);
    command.force_N += sign_ * size_N_;
    return command;
  }

 private:
  static Loop softened(Loop loop) {
    loop.bandwidth_Hz = std::min(loop.bandwidth_Hz, 0.8);
    loop.integral = 0;
    return loop;
  }
  double size_N_;
  double bit_s_;
  double sign_ = 1;
  double next_s_ = 0;
};

// What drives and lets go by turns: the drive is off until the axis rests.
class LettingGo : public Operator {
 public:
  LettingGo(const RunPlan& run, const Machine& machine)
      : m_(machine), dice_(run.seed), speed_(machine.period_s, 10 * machine.period_s) {}
  Command command(double t_s, double reading_m) override {
    const double speed = speed_.update(reading_m);
    if (free_) {
      const bool moves = std::abs(speed) > 0.01 * m_.top_speed_m_per_s;
      const bool leaves = reading_m < -0.2 * m_.stroke_m || reading_m > 1.2 * m_.stroke_m;
      since_s_ = moves && !leaves ? t_s : since_s_;
      if (t_s - since_s_ < kRest_s && t_s - let_go_s_ < kLongest_s) {
        return {};
      }
      free_ = false;
      begin(t_s, reading_m);
    }
    if (is_over(t_s)) {
      free_ = true;
      since_s_ = t_s;
      let_go_s_ = t_s;
      return {};
    }
    return {drive_N(t_s, reading_m), {}};
  }
  [[nodiscard]] double start_m() const override { return 0.5 * m_.stroke_m; }

 protected:
  virtual void begin(double t_s, double reading_m) = 0;
  virtual double drive_N(double t_s, double reading_m) = 0;
  [[nodiscard]] virtual bool is_over(double t_s) const = 0;

  const Machine& m_;
  Dice dice_;

 private:
  static constexpr double kRest_s = 0.25;
  static constexpr double kLongest_s = 4;
  SpeedEstimate speed_;
  bool free_ = true;
  double since_s_ = 0;
  double let_go_s_ = 0;
};

// Pulses towards where there is more room.
class Pulses : public LettingGo {
 public:
  using LettingGo::LettingGo;

 protected:
  void begin(double t_s, double reading_m) override {
    const double off = reading_m / m_.stroke_m - 0.5;
    sign_ = std::abs(off) > 0.15 ? -direction(off) : -sign_;
    const double a = m_.acceleration_m_per_s2 * dice_.between(0.4, 1);
    // The pulse and the way out after it stay within a third of the stroke.
    const double slowing = (m_.coulomb_N + 0.2 * m_.inertial_N()) / m_.mass_kg;
    const double most = std::sqrt(0.66 * m_.stroke_m / (1 / a + 1 / slowing));
    const double speed = std::min(m_.top_speed_m_per_s, most) * dice_.between(0.4, 1);
    force_N_ = sign_ * (m_.coulomb_N + m_.mass_kg * a);
    until_s_ = t_s + speed / a;
  }
  double drive_N(double /*t_s*/, double /*reading_m*/) override { return force_N_; }
  [[nodiscard]] bool is_over(double t_s) const override { return t_s >= until_s_; }

 private:
  double sign_ = -1;
  double force_N_ = 0;
  double until_s_ = 0;
};

// Brought to speed by the loop, then left alone.
class Coast : public LettingGo {
 public:
  Coast(const RunPlan& run, const Machine& machine, const Loop& loop)
      : LettingGo(run, machine), loop_(machine, loop) {}
  Command command(double t_s, double reading_m) override {
    loop_.observe(reading_m);
    return LettingGo::command(t_s, reading_m);
  }

 protected:
  void begin(double t_s, double reading_m) override {
    const double to = reading_m < 0.5 * m_.stroke_m ? m_.stroke_m : 0;
    const double speed = m_.top_speed_m_per_s * dice_.between(0.3, 1);
    way_ = Way(reading_m);
    way_.move(to, speed, m_.acceleration_m_per_s2);
    from_s_ = t_s;
    until_s_ = t_s + dice_.between(0.4, 0.8) * way_.duration_s();
    loop_.forget();
  }
  double drive_N(double t_s, double reading_m) override {
    return loop_.force_N(way_.at(t_s - from_s_), reading_m);
  }
  [[nodiscard]] bool is_over(double t_s) const override { return t_s >= until_s_; }

 private:
  PositionLoop loop_;
  Way way_{0};
  double from_s_ = 0;
  double until_s_ = 0;
};

// On and off about a place, with a band.
class Relay : public Operator {
 public:
  Relay(const RunPlan& run, const Machine& machine) : m_(machine) {
    Dice dice(run.seed);
    size_N_ = machine.coulomb_N + dice.between(0.3, 0.8) * machine.inertial_N();
    band_m_ = machine.stroke_m * dice.between(0.02, 0.08);
  }
  Command command(double /*t_s*/, double reading_m) override {
    const double off = reading_m - start_m();
    sign_ = off > band_m_ ? -1 : off < -band_m_ ? 1 : sign_;
    return {sign_ * size_N_, {}};
  }
  [[nodiscard]] double start_m() const override { return 0.5 * m_.stroke_m; }

 private:
  const Machine& m_;
  double size_N_ = 0;
  double band_m_ = 0;
  double sign_ = 1;
};

// Somebody leans on the load now and then.
class Pushed : public Follower {
 public:
  Pushed(const RunPlan& run, const Machine& machine, const Loop& loop)
      : Follower(run, machine, loop),
        size_N_(machine.coulomb_N * dice_.between(0.4, 1)),
        every_s_(run.duration_s / 4) {}
  // From one side and from the other, or it were a bias.
  [[nodiscard]] double hand_N(double t_s, double /*x_m*/, double /*v_m_per_s*/) const override {
    constexpr double kLasts_s = 1.5;
    const double since_s = std::fmod(t_s, every_s_) - 0.4 * every_s_;
    const double side = std::fmod(t_s, 2 * every_s_) < every_s_ ? 1 : -1;
    return since_s > 0 && since_s < kLasts_s
               ? side * size_N_ * std::sin(0.5 * kTurn * since_s / kLasts_s)
               : 0;
  }

 private:
  double size_N_;
  double every_s_;
};

// A hand is a soft spring to where it wants to be.
class Hand : public Operator {
 public:
  Hand(const RunPlan& run, const Machine& machine)
      : m_(machine), dice_(run.seed), way_(draw_way(run.motion, machine, run.duration_s, dice_)) {}
  Command command(double /*t_s*/, double /*reading_m*/) override { return {}; }
  [[nodiscard]] double hand_N(double t_s, double x_m, double v_m_per_s) const override {
    constexpr double kSoft = kTurn * 1.5;
    const Wanted wanted = way_.at(t_s);
    const double force =
        m_.mass_kg * kSoft * (kSoft * (wanted.x_m - x_m) + 1.4 * (wanted.v_m_per_s - v_m_per_s)) +
        0.8 * m_.coulomb_N * std::tanh(6 * wanted.v_m_per_s / m_.top_speed_m_per_s);
    const double most = m_.coulomb_N + m_.inertial_N();
    return std::clamp(force, -most, most);
  }
  [[nodiscard]] double start_m() const override { return way_.at(0).x_m; }

 private:
  const Machine& m_;
  Dice dice_;
  Way way_;
};

}  // namespace

double SpeedEstimate::update(double reading_m) {
  const double raw = (reading_m - last_m_.value_or(reading_m)) / period_s_;
  last_m_ = reading_m;
  speed_ += (1 - std::exp(-period_s_ / filter_s_)) * (raw - speed_);
  return speed_;
}

std::unique_ptr<Operator> make_operator(const RunPlan& run, const Machine& machine,
                                        const Loop& loop) {
  if (run.motion == "prbs") return std::make_unique<Prbs>(run, machine, loop);
  if (run.motion == "pulses") return std::make_unique<Pulses>(run, machine);
  if (run.motion == "coast") return std::make_unique<Coast>(run, machine, loop);
  if (run.motion == "relay") return std::make_unique<Relay>(run, machine);
  if (run.motion == "hand") return std::make_unique<Hand>(run, machine);
  if (run.motion == "pushed") return std::make_unique<Pushed>(run, machine, loop);
  return std::make_unique<Follower>(run, machine, loop);
}

}  // namespace towbench::tests::foreign
