// A physical effect as the diagnosis knows it: columns whose sum, with coefficients, is the force
// that the command must make in addition to the nominal model's. One name each, part of the
// interface. What it can be confused with is computed from the data, never listed.
#pragma once

#include <Eigen/Core>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "study/diagnose/dataset.h"
#include "study/diagnose/nominal_model.h"

namespace towbench::harness::diagnose {

// What an effect may know besides the signals: the model, its refit, and the data's ranges.
struct Context {
  NominalModel model;
  Theta theta = Theta::Zero();  // refitted nominal structure
  double top_speed_m_per_s = 0;
  double stroke_min_m = 0;
  double stroke_max_m = 0;
  double resolution_m = 0;
  double acceleration_noise_m_per_s2 = 0;  // of the encoder's steps, in the signals
  double quiet_Hz = 0;  // below it the encoder's steps are next to nothing beside the input
  double largest_input_N = 0;
  double period_s = 0;
  double cutoff_Hz = 0;
  double duration_s = 0;

  [[nodiscard]] Eigen::VectorXd model_force_N(const Signals& signals) const {
    // What a chain passes on is seen, not modelled: at the motor, and at the load.
    return model.elastic() ? signals.force_N() : base_columns(signals) * theta;
  }
};

using Scales = std::vector<double>;
// kChain: no force at all, but a term of the load's law (elastic_axis.h).
enum class ActsOn { kMotor, kLoad, kBoth, kChain };
enum class LineSearch { kNone, kPosition, kTime };

struct Effect {
  std::string name = {};
  std::string cause = {};                      // in words, after "the model lacks"
  std::vector<std::string> coefficients = {};  // names with units, one a column
  std::vector<std::string> scales = {};        // names with units of what enters nonlinearly
  bool first_is_positive = false;              // otherwise the physics allows both signs
  double first_by_law = 0;          // 1: a clip takes all that exceeds its level, and no more
  bool first_is_its_scale = false;  // one quantity twice: they must agree within a factor of two
  bool differs_between_sessions = false;  // its phase hangs on where the encoder was switched on
  // The base column that the mean of its shape falls into, -1 for none: with the effect found, that
  // column's parameter is no longer comparable with the supplied one.
  int shares_mean_with = -1;
  Eigen::Index chain_part = -1;  // of its first coefficient, where they are the chain's own
  ActsOn acts_on = ActsOn::kMotor;
  LineSearch search = LineSearch::kNone;  // its one scale is a frequency sought in the residual
  std::string needs = {};                 // the data that would show it
  std::vector<Scales> (*grid)(const Context&) = nullptr;
  Eigen::MatrixXd (*columns)(const Signals&, const Context&, std::span<const double>) = nullptr;
};

// An effect's columns where they act: what acts on the load is computed from the load's motion,
// friction is on both bodies. A rigid axis has a motor only.
struct ActingColumns {
  Eigen::MatrixXd on_motor;
  Eigen::MatrixXd on_load;
};
[[nodiscard]] ActingColumns acting_columns(const Effect& effect, const Signals& signals,
                                           const Context& context, std::span<const double> scales);
// The same as the fit needs them: of the load's law, where there is a load.
[[nodiscard]] Eigen::MatrixXd effect_columns(const Effect& effect, const Signals& signals,
                                             const Context& context,
                                             std::span<const double> scales);

using Library = std::vector<Effect>;

// Every effect, in the interface's order within each family.
[[nodiscard]] const Library& effect_library();
[[nodiscard]] const Effect* find_effect(std::string_view name);

// The families; each lives in its own file below effects/.
void add_friction_effects(Library& library);
void add_low_speed_effects(Library& library);
void add_drive_effects(Library& library);
void add_mechanical_effects(Library& library);
void add_position_effects(Library& library);
void add_periodic_effects(Library& library);
void add_session_effects(Library& library);

// For effects whose columns need no scale.
[[nodiscard]] inline std::vector<Scales> no_scale(const Context& /*context*/) {
  return {{}};
}

}  // namespace towbench::harness::diagnose
