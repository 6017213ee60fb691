#include "study/extended_plant/emulated_log.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>

#include "core/axis.h"
#include "core/time.h"
#include "emulator/plant/axis_plant.h"
#include "emulator/water/water.h"
#include "study/extended_plant/plant_text.h"
#include "study/prediction/scene.h"

namespace towbench::study::diagnose {
namespace {

using Eigen::Index;
using Eigen::VectorXd;

constexpr double kLine_s = 0.04;  // whose line is a speed
constexpr double kUnlimited_V = 1e6;
constexpr double kTick_s = core::kPlantTick_s;
constexpr double kRadians = 2 * std::numbers::pi;  // of a turn

// What turns a log's newtons into volts, and an encoder's counts into metres.
struct LogUnits {
  double newton_per_volt = 1;
  double metres_per_count = 1;
};

const emulator::RigAxisParameters& axis_of(const emulator::RigParameters& machine,
                                           const NominalModel& stated) {
  return machine.axes[*core::axis_named(stated.axis)];
}

LogUnits units_of_log(const emulator::RigAxisParameters& axis) {
  const emulator::AxisParameters& p = axis.plant;
  const double r = p.output_radius_m / p.gear_ratio;
  return {p.torque_constant_Nm_per_A * p.amplifier_gain_A_per_V / r,
          kRadians * r / static_cast<double>(axis.encoder.counts_per_turn)};
}

// Of a file without a motor: an ampere makes a newton at any speed.
void make_ideal(emulator::AxisParameters& plant) {
  const double r = plant.output_radius_m / plant.gear_ratio;
  const double newton_per_A = plant.torque_constant_Nm_per_A / r;
  plant.torque_constant_Nm_per_A = r;
  plant.amplifier_gain_A_per_V *= newton_per_A;
  plant.current_limit_A *= newton_per_A;
  plant.winding = {.resistance_ohm = 1, .inductance_H = 0.4e-3, .choke_inductance_H = 0};
}

// What a log does not show is left out: stops, and a motor that the file does not state.
emulator::AxisParameters replayed(emulator::AxisParameters plant, const NominalModel& stated,
                                  const emulator::WaterParameters& water) {
  plant.hard_ends.fitted = false;
  if (stated.no_load_speed_m_per_s <= 0) make_ideal(plant);
  if (water.present() && core::is_planar(*core::axis_named(stated.axis))) {
    plant.water_mass_kg = added_mass_kg(water);
  }
  return plant;
}

// A machine that stands where a log begins.
class EmulatedAxis {
 public:
  EmulatedAxis(const emulator::RigParameters& machine, const NominalModel& stated,
               const LogUnits& units, double at_m)
      : axis_(axis_of(machine, stated)),
        which_(*core::axis_named(stated.axis)),
        units_(units),
        plant_(replayed(axis_.plant, stated, machine.water), at_m) {
    if (machine.water.present() && core::is_planar(which_)) water_.emplace(machine.water);
    input_.supply_V = stated.no_load_speed_m_per_s > 0 ? machine.supply.voltage_V : kUnlimited_V;
    input_.amplifier_enabled = true;
    off_m_ = reading_m() - at_m;
  }

  // So that its encoder reads so much more and faster.
  void displace(double by_m, double by_m_per_s) {
    const double r = axis_.plant.output_radius_m / axis_.plant.gear_ratio;
    const double read_per_m = on_load() ? 1 : read_per_rad(plant_.state().motor_angle_rad) / r;
    plant_.displace(by_m / read_per_m, by_m_per_s / read_per_m);
  }

  void tick(double input_N) {
    input_.command_V = input_N / units_.newton_per_volt;
    input_.carriage_force_N = 0;
    if (water_) {
      core::PerPlanarAxis<double> velocity{};
      velocity[which_] = plant_.state().carriage_speed_m_per_s;
      input_.carriage_force_N += water_->force_N(0, velocity)[which_];
    }
    plant_.step(input_, segments_);
  }

  [[nodiscard]] double reading_m() const {
    const emulator::AxisState state = plant_.state();
    if (on_load()) return state.carriage_m - off_m_;
    const emulator::EncoderParameters& e = axis_.encoder;
    const double turns = state.motor_angle_rad / kRadians;
    const double counts =
        turns * static_cast<double>(e.counts_per_turn) +
        e.eccentricity_counts * std::sin(kRadians * (turns - e.eccentricity_phase_deg / 360));
    return counts * units_.metres_per_count - off_m_;
  }

 private:
  [[nodiscard]] bool on_load() const { return axis_.encoder.side == emulator::EncoderSide::kLoad; }
  // What a radian of the motor adds to the reading.
  [[nodiscard]] double read_per_rad(double motor_rad) const {
    const emulator::EncoderParameters& e = axis_.encoder;
    const double wave = std::cos(motor_rad - kRadians * e.eccentricity_phase_deg / 360);
    return (static_cast<double>(e.counts_per_turn) / kRadians + e.eccentricity_counts * wave) *
           units_.metres_per_count;
  }

  const emulator::RigAxisParameters& axis_;
  core::Axis which_;
  LogUnits units_;
  emulator::AxisPlant plant_;
  std::optional<emulator::Water> water_;
  emulator::AxisInput input_;
  emulator::MotionSegments segments_;
  double off_m_ = 0;
};

// The machine along one run, in its own ticks.
class Replayed {
 public:
  Replayed(EmulatedAxis& axis, const Scene& scene)
      : axis_(axis), scene_(scene), before_m_(axis.reading_m()) {}

  // At sample `k`; calls go forward.
  double reading_m(Index k) {
    const Run& run = *scene_.run;
    const double at_s = static_cast<double>(k) * run.period_s;
    while (now_s() < at_s - 1e-9) {
      before_m_ = axis_.reading_m();
      axis_.tick(scene_.mean_input_N(now_s(), kTick_s));
      ++ticks_;
    }
    const double after_m = axis_.reading_m();
    return after_m - (now_s() - at_s) / kTick_s * (after_m - before_m_);
  }
  void displace(double by_m, double by_m_per_s) {
    axis_.displace(by_m, by_m_per_s);
    before_m_ = axis_.reading_m();
  }

 private:
  [[nodiscard]] double now_s() const { return static_cast<double>(ticks_) * kTick_s; }

  EmulatedAxis& axis_;
  const Scene& scene_;
  double before_m_;
  std::int64_t ticks_ = 0;
};

// Of a line through values that lie `period_s` apart.
double slope_of(const Eigen::Ref<const VectorXd>& values, double period_s) {
  const auto n = static_cast<double>(values.size());
  const VectorXd t = VectorXd::LinSpaced(values.size(), -0.5 * (n - 1), 0.5 * (n - 1)) * period_s;
  return t.dot((values.array() - values[0]).matrix()) / t.squaredNorm();  // 0 where all are alike
}

// Measured less emulated, from the log's start and its speed there. At the ends of windows of
// `length` samples, if there are any, the machine is put back on the log by as much as it is off in
// place and in speed; what flows, bends and warms goes on.
VectorXd off_m(EmulatedAxis axis, const Scene& scene, std::optional<Index> length) {
  const Run& run = *scene.run;
  const auto line = std::clamp<Index>(std::lround(kLine_s / run.period_s), 2, run.size());
  VectorXd off(run.size());
  Replayed replayed(axis, scene);
  replayed.displace(0, slope_of(run.position_m.head(line), run.period_s));
  for (Index k = 0; k < run.size(); ++k) {
    off[k] = run.position_m[k] - replayed.reading_m(k);
    if (length && k > 0 && k % *length == 0) {
      replayed.displace(off[k], slope_of(off.segment(k + 1 - line, line), run.period_s));
    }
  }
  return off;
}

// Squares of the distances at the ends of the windows in which all is measured.
std::vector<double> windows_of(const EmulatedAxis& axis, const Scene& scene) {
  const Index length = std::max<Index>(2, std::lround(kWindow_s / scene.run->period_s));
  const VectorXd off = off_m(axis, scene, length);
  std::vector<double> squares;
  for (Index k = length; k < off.size(); k += length) {
    if (scene.run->is_measured(k - length, k + 1)) squares.push_back(off[k] * off[k]);
  }
  return squares;
}

double whole(const EmulatedAxis& axis, const Scene& scene) {
  const VectorXd off = off_m(axis, scene, std::nullopt);
  return off.norm() / std::sqrt(static_cast<double>(off.size()));
}

struct Distances {
  std::vector<double> squares;
  double whole_m = 0;
};

Distances distances(const emulator::RigParameters& machine, const NominalModel& stated,
                    const LogUnits& units, const std::vector<Scene>& scenes) {
  Distances out;
  const auto at_start = [&](const Scene& scene) {
    return EmulatedAxis(machine, stated, units, scene.run->position_m[0]);
  };
  const Scene* longest = &scenes.front();
  for (const Scene& scene : scenes) {
    const auto of_run = windows_of(at_start(scene), scene);
    out.squares.insert(out.squares.end(), of_run.begin(), of_run.end());
    if (scene.run->size() > longest->run->size()) longest = &scene;
  }
  out.whole_m = whole(at_start(*longest), *longest);
  return out;
}

}  // namespace

Emulated emulate(const std::vector<Run>& runs, const NominalModel& stated,
                 const toml::table& supplied, const toml::table& extended) {
  std::vector<Scene> scenes;
  for (const Run& run : runs) scenes.emplace_back(run, stated);
  const emulator::RigParameters before = machine_of(supplied);
  const emulator::RigParameters after = machine_of(extended);
  const LogUnits units = units_of_log(axis_of(before, stated));
  const Distances of_supplied = distances(before, stated, units, scenes);
  const Distances of_extended = distances(after, stated, units, scenes);
  Emulated out;
  out.whole_supplied_m = of_supplied.whole_m;
  out.whole_extended_m = of_extended.whole_m;
  out.windows = compare_windows(of_supplied.squares, of_extended.squares, 1);
  return out;
}

}  // namespace towbench::study::diagnose
