#include "tests/study/diagnose/foreign/recording.h"

#include <algorithm>
#include <cmath>

#include "tests/study/diagnose/foreign/drive.h"
#include "tests/study/diagnose/foreign/dry_bodies.h"
#include "tests/study/diagnose/foreign/operator.h"

namespace towbench::tests::foreign {
namespace {

double total(const std::vector<Law>& laws, Force Law::*force, const Now& now) {
  double sum = 0;
  for (const Law& law : laws) {
    sum += law.*force ? (law.*force)(now) : 0;
  }
  return sum;
}
double total(const std::vector<Law>& laws, double Law::*value) {
  double sum = 0;
  for (const Law& law : laws) {
    sum += law.*value;
  }
  return sum;
}
double largest(const std::vector<Law>& laws, double Law::*value) {
  double most = 0;
  for (const Law& law : laws) {
    most = std::max(most, law.*value);
  }
  return most;
}

// One run: the machine as it is, not as the file says.
class Rig {
 public:
  Rig(const Machine& machine, const std::vector<Law>& laws, const Session& session,
      const RunPlan& run, std::uint64_t seed)
      : m_(machine),
        laws_(laws),
        session_(session),
        drive_(machine, laws),
        noise_(seed, run.seed),
        unstated_(total(laws, &Law::gravity_unstated)),
        presliding_m_(total(laws, &Law::presliding_m)),
        breakaway_N_(total(laws, &Law::breakaway_N)),
        coulomb_N_(session.friction * machine.coulomb_N + total(laws, &Law::coulomb_N)),
        hand_drives_(run.motion == "hand"),
        t_s_(run.start_s) {}

  void place(double reading_m) {
    double x_m = reading_m - session_.origin_m;
    for (int i = 0; i < 60; ++i) {
      x_m += reading_m - reading_at(x_m);
    }
    bodies_ = make_bodies(x_m);
  }
  [[nodiscard]] double count_m() const {
    return (std::floor(reading_at(bodies_.motor().x_m) / m_.metres_per_count) + 0.5) *
           m_.metres_per_count;
  }
  [[nodiscard]] double stated_gravity() const { return 1 - unstated_; }
  // Holds a command for a sample; who drives may push at every step.
  Truth hold(double command_N, int steps, double h_s, const Operator& who, double clock_s) {
    Truth truth;
    truth.command_N = command_N;
    const Balance before = balance();
    truth.t_s = clock_s;
    truth.x_m = before.reading_m;
    const double share = 1.0 / steps;
    drive_.command(command_N);
    for (int i = 0; i < steps; ++i) {
      const Body& pushed = hand_drives_ ? bodies_.motor() : bodies_.load();
      const double hand_N = who.hand_N(clock_s + i * h_s, pushed.x_m, pushed.v_m_per_s);
      truth.hand_N += share * hand_N;
      const Step done = step(h_s, hand_N);
      truth.dry += share * done.dry;
      truth.moving += share * done.moving;
      truth.lacking_N += share * (-done.nominal_N);
    }
    const Balance after = balance();
    const double duration_s = steps * h_s;
    truth.v_m_per_s = (after.reading_m - before.reading_m) / duration_s;
    truth.a_m_per_s2 = (after.speed - before.speed) / duration_s;
    truth.lacking_N += command_N + truth.hand_N - (after.momentum - before.momentum) / duration_s;
    return truth;
  }

 private:
  struct Step {
    double dry = 0;  // of Coulomb
    double moving = 0;
    double nominal_N = 0;  // what the file's friction and gravity take
  };
  // What the file's inertia has, by what can be read.
  struct Balance {
    double reading_m = 0;
    double speed = 0;
    double momentum = 0;
  };

  [[nodiscard]] double read(double x_m) const {
    for (const Law& law : laws_) {
      x_m = law.reading_m ? law.reading_m(x_m) : x_m;
    }
    return x_m;
  }
  [[nodiscard]] double reading_at(double x_m) const { return read(x_m) + session_.origin_m; }
  [[nodiscard]] double reading_rate() const {
    constexpr double kReach_m = 1e-6;
    const double x = bodies_.motor().x_m;
    return (read(x + kReach_m) - read(x - kReach_m)) / (2 * kReach_m);
  }
  [[nodiscard]] Balance balance() const {
    const double speed = reading_rate() * bodies_.motor().v_m_per_s;
    const bool stated = m_.chain_Hz > 0;  // the file knows of the load
    const double momentum = stated ? m_.mass_kg * (m_.motor_share * speed +
                                                   (1 - m_.motor_share) * bodies_.load().v_m_per_s)
                                   : m_.mass_kg * speed;
    return {reading_at(bodies_.motor().x_m), speed, momentum};
  }

  [[nodiscard]] DryBodies make_bodies(double x_m) const {
    const double mass_kg = m_.mass_kg + total(laws_, &Law::added_kg);
    const double viscous = m_.viscous_N_s_per_m + total(laws_, &Law::viscous_N_s_per_m);
    const double hidden_Hz = largest(laws_, &Law::chain_Hz);
    const double chain_Hz = hidden_Hz > 0 ? hidden_Hz : m_.chain_Hz;
    if (chain_Hz == 0) {
      return {{mass_kg, viscous, x_m, 0}, {}, {}};
    }
    const double motor_kg = m_.motor_share * m_.mass_kg;
    const double pulsation = kTurn * chain_Hz;
    const double play_m = largest(laws_, &Law::play_m);
    const double damping = play_m > 0 ? 0.2 : m_.chain_damping;
    const Link link{m_.reduced_kg() * pulsation * pulsation,
                    2 * damping * m_.reduced_kg() * pulsation, play_m};
    return {{motor_kg, (1 - m_.load_friction) * viscous, x_m, 0},
            {mass_kg - motor_kg, m_.load_friction * viscous, x_m, 0},
            link};
  }

  [[nodiscard]] Now now(const Body& body, double h_s, double drive_N) const {
    return {t_s_, h_s, body.x_m, body.v_m_per_s, acceleration_, drive_N};
  }
  [[nodiscard]] double level_N(const Now& at) const {
    const double level = coulomb_N_ + total(laws_, &Law::dry_N, at);
    return std::max(0.0, level + (at.v_m_per_s == 0 ? breakaway_N_ : 0));
  }

  Step step(double h_s, double hand_N) {
    if (t_s_ >= next_noise_s_) {
      noise_N_ = m_.torque_noise_N * noise_.gauss();
      next_noise_s_ = t_s_ + kNoiseHold_s * (1 - 1e-9);
    }
    // The transmission passes on a hand's push at the motor as it does the drive's.
    const double drive_N =
        drive_.step(h_s, now(bodies_.motor(), h_s, drive_.force_N())) + (hand_drives_ ? hand_N : 0);
    const Now motor = now(bodies_.motor(), h_s, drive_N);
    const Now load = now(bodies_.load(), h_s, drive_N);
    ForcePair push{drive_N + noise_N_ + total(laws_, &Law::on_motor_N, motor) +
                       total(laws_, &Law::memory_N, motor),
                   session_.offset_N + (hand_drives_ ? 0 : hand_N) +
                       total(laws_, &Law::on_load_N, load) - m_.gravity_at_N(bodies_.load().x_m)};
    const double on_load = bodies_.two() ? m_.load_friction : 0;
    ForcePair grip{(1 - on_load) * level_N(motor), on_load * level_N(load)};
    if (presliding_m_ > 0) {
      push.motor_N -= bristle_N(grip.motor_N);
      grip.motor_N = 0;
    }
    const DryBodies before = bodies_;
    const ForcePair dry = bodies_.step(h_s, push, grip);
    acceleration_ = (bodies_.motor().v_m_per_s - before.motor().v_m_per_s) / h_s;
    strain_ = presliding_m_ > 0 ? strained(h_s * bodies_.motor().v_m_per_s) : 0;
    t_s_ += h_s;
    return stated(before, dry, on_load);
  }

  // Dahl: the friction force follows the way, not the speed; the step's way is integrated exactly.
  [[nodiscard]] double bristle_N(double level_N) const {
    // Bristles have a little damping of their own, or an axis at rest rings for ever.
    const double damping = 0.4 * std::sqrt(m_.mass_kg * m_.coulomb_N / presliding_m_);
    return level_N * strain_ + damping * (1 - std::abs(strain_)) * bodies_.motor().v_m_per_s;
  }
  [[nodiscard]] double strained(double way_m) const {
    const double end = way_m > 0 ? 1 : -1;
    return end - (end - strain_) * std::exp(-std::abs(way_m) / presliding_m_);
  }

  // What the file's law says of the step that was made.
  [[nodiscard]] Step stated(const DryBodies& before, const ForcePair& dry, double on_load) const {
    Step out;
    const double creep = 1e-4 * m_.top_speed_m_per_s;
    const auto resist = [&](const Body& from, const Body& to, double resisted_N, double share,
                            double rate) {
      const double most = share * m_.coulomb_N;
      const bool moves = std::abs(to.v_m_per_s) > creep && from.v_m_per_s * to.v_m_per_s > 0;
      out.moving += share * (moves ? 1 : 0);
      const double taken_N =
          moves ? std::copysign(most, to.v_m_per_s) : std::clamp(resisted_N, -most, most);
      out.dry += taken_N / m_.coulomb_N;
      out.nominal_N +=
          taken_N + share * m_.viscous_N_s_per_m * rate * 0.5 * (from.v_m_per_s + to.v_m_per_s);
    };
    const bool load_is_stated = m_.chain_Hz > 0;
    const double motor_N = presliding_m_ > 0 ? coulomb_N_ * strain_ : dry.motor_N;
    resist(before.motor(), bodies_.motor(), load_is_stated ? motor_N : motor_N + dry.load_N,
           load_is_stated ? 1 - on_load : 1, reading_rate());
    if (load_is_stated) {
      resist(before.load(), bodies_.load(), dry.load_N, on_load, 1);
    }
    out.nominal_N += stated_gravity() * m_.gravity_at_N(before.load().x_m);
    return out;
  }

  const Machine& m_;
  const std::vector<Law>& laws_;
  Session session_;
  Drive drive_;
  Dice noise_;
  double unstated_;
  double presliding_m_;
  double breakaway_N_;
  double coulomb_N_;
  bool hand_drives_;
  double t_s_;
  DryBodies bodies_{{}, {}, {}};
  double acceleration_ = 0;
  double strain_ = 0;
  double noise_N_ = 0;
  double next_noise_s_ = 0;
};

Recording record_run(const Machine& machine, const std::vector<Law>& laws, const Plan& plan,
                     const RunPlan& run, std::uint64_t seed, double step_s) {
  Recording out;
  out.plan = run;
  const auto who = make_operator(run, machine, plan.loop);
  Rig rig(machine, laws, plan.sessions[run.session], run, seed);
  out.stated_gravity = rig.stated_gravity();
  rig.place(who->start_m());
  const int steps = static_cast<int>(std::ceil(machine.period_s / step_s - 1e-9));
  const double h_s = machine.period_s / steps;
  const auto samples = static_cast<int>(run.duration_s / machine.period_s);
  for (int k = 0; k < samples; ++k) {
    const double t_s = k * machine.period_s;
    const double reading_m = rig.count_m();
    const Command command = who->command(t_s, reading_m);
    // Who drives a joint holds it against gravity.
    const double wanted_N = command.force_N + machine.gravity_at_N(reading_m);
    const double units = in_steps(machine, wanted_N / machine.newton_per_unit);
    out.truth.push_back(rig.hold(units * machine.newton_per_unit, steps, h_s, *who, t_s));
    out.position_m.push_back(reading_m);
    out.input_units.push_back(units);
    if (command.reference_m && plan.with_reference) {
      out.reference_m.push_back(*command.reference_m);
    }
  }
  return out;
}

}  // namespace

std::vector<Recording> record(const Machine& machine, const std::vector<Hidden>& hidden,
                              const Plan& plan, std::uint64_t seed, double step_s) {
  std::vector<Recording> all;
  std::vector<Law> laws;
  for (std::size_t i = 0; i < plan.runs.size(); ++i) {
    if (i == 0 || plan.runs[i].session != plan.runs[i - 1].session) {
      laws.clear();
      for (const Hidden& one : hidden) {
        laws.push_back(find(one.name)->law(one, machine));
      }
    }
    all.push_back(record_run(machine, laws, plan, plan.runs[i], seed, step_s));
  }
  return all;
}

study::diagnose::Run run_of(const Machine& machine, const Recording& recording) {
  const auto vector = [](const std::vector<double>& from) {
    return Eigen::VectorXd(
        Eigen::Map<const Eigen::VectorXd>(from.data(), static_cast<Eigen::Index>(from.size())));
  };
  study::diagnose::Run run;
  run.name = recording.plan.motion;
  run.period_s = machine.period_s;
  run.start_s = recording.plan.start_s;
  run.position_m = vector(recording.position_m);
  run.input_N = machine.newton_per_unit * vector(recording.input_units);
  if (recording.plan.motion == "hand") {
    for (Eigen::Index k = 0; k < run.size(); ++k) {
      run.input_N[k] += recording.truth[static_cast<std::size_t>(k)].hand_N;  // of a force sensor
    }
  }
  run.reference_m = vector(recording.reference_m);
  run.missing.assign(recording.position_m.size(), 0);
  run.resolution_m = machine.metres_per_count;
  run.input_step_N = machine.force_step_N();
  return run;
}

}  // namespace towbench::tests::foreign
