// Amplifier, command path and supply: what happens between the logged command and the force.
#include <algorithm>
#include <cmath>

#include "study/diagnose/effect.h"
#include "study/diagnose/elastic_axis.h"

namespace towbench::harness::diagnose {
namespace {

using Eigen::ArrayXd;
using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

// The force that acts now was commanded d ago: F(t) = u(t - d), so u(t) - F(t) = F(t + d) - F(t).
// The difference is as wide as the delay itself: a wider one looks ahead, to where the controller
// answers the encoder's steps, and beats a lag by that alone.
MatrixXd transport_delay(const Signals& s, const Context& c, std::span<const double> scale) {
  const VectorXd force = c.model_force_N(s);
  const double samples = scale[0] / s.period_s;
  const auto whole = static_cast<Index>(samples);
  const double part = samples - static_cast<double>(whole);
  VectorXd column(s.size());
  for (Index i = 0; i < s.size(); ++i) {
    const Index at = std::min(i + whole, s.size() - 1);
    const Index next = std::min(at + 1, s.size() - 1);
    column[i] = ((1 - part) * force[at] + part * force[next] - force[i]) / scale[0];
  }
  return column;
}

std::vector<Scales> delay_grid(const Context& c) {
  return {{0.15 * c.period_s}, {0.5 * c.period_s}, {c.period_s},     {2 * c.period_s},
          {4 * c.period_s},    {8 * c.period_s},   {16 * c.period_s}};
}

// tau F' + F = u. The difference has a width of its own: a narrow one is mostly the encoder's
// steps, differentiated three times.
MatrixXd current_loop_lag(const Signals& s, const Context& c, std::span<const double> scale) {
  const VectorXd force = c.model_force_N(s);
  const auto reach = std::max<Index>(1, std::lround(0.5 * scale[0] / s.period_s));
  VectorXd column(s.size());
  for (Index i = 0; i < s.size(); ++i) {
    const Index from = std::max<Index>(i - reach, 0);
    const Index to = std::min(i + reach, s.size() - 1);
    column[i] = (force[to] - force[from]) / (static_cast<double>(to - from) * s.period_s);
  }
  return column;
}

std::vector<Scales> width_grid(const Context& c) {
  return {{0.5 * c.period_s}, {2 * c.period_s}, {5 * c.period_s}, {0.1 / c.cutoff_Hz}};
}

// (1 + g) u = F: everything scales by 1/(1+g); in the span of the refitted structure.
MatrixXd amplifier_gain(const Signals& s, const Context& c, std::span<const double>) {
  return s.load != nullptr ? s.load->by_gain : c.model_force_N(s);
}

// Nothing happens until |u| > d: u = F + d sgn F.
MatrixXd amplifier_deadband(const Signals& s, const Context& c, std::span<const double>) {
  const double soft = 0.02 * c.largest_input_N;
  return (s.force_N().array() / soft).tanh().matrix();
}

// The amplifier clips at a level below the logged command: u - F = excess of |u| over it.
MatrixXd command_saturation(const Signals& s, const Context& c, std::span<const double> scale) {
  const ArrayXd level = ArrayXd::Constant(s.size(), scale[0] * c.largest_input_N);
  const ArrayXd force = s.force_N().array();
  return ((force.abs() - level).max(0.0) * force.sign()).matrix();
}

// The same with a level that back-EMF lowers with speed in the direction of the force.
MatrixXd voltage_saturation(const Signals& s, const Context& c, std::span<const double> scale) {
  const ArrayXd force = s.force_N().array();
  const ArrayXd sign = force.sign();
  const ArrayXd along = s.speed_m_per_s.array() * sign / c.model.no_load_speed_m_per_s;
  const ArrayXd level = scale[0] * c.model.force_limit_N * (1.0 - along).max(0.0);
  return ((force.abs() - level).max(0.0) * sign).matrix();
}

std::vector<Scales> clip_grid(const Context& /*c*/) {
  return {{0.3}, {0.4}, {0.5}, {0.6}, {0.7}, {0.8}, {0.9}, {0.95}};
}

std::vector<Scales> stall_grid(const Context& c) {
  if (c.model.no_load_speed_m_per_s <= 0 || c.model.force_limit_N <= 0) {
    return {};
  }
  return {{0.2}, {0.3}, {0.4}, {0.5}, {0.6}, {0.7}, {0.8}, {0.9}};
}

// A constant force, whatever the motion.
MatrixXd constant_bias(const Signals& s, const Context& /*c*/, std::span<const double>) {
  return MatrixXd::Ones(s.size(), 1);
}

}  // namespace

void add_drive_effects(Library& library) {
  library.push_back({.name = "transport_delay",
                     .cause = "a delay between command and force",
                     .coefficients = {"delay_s"},
                     .scales = {"spacing_s"},
                     .first_is_positive = true,
                     .first_is_its_scale = true,
                     .needs = "fast accelerations",
                     .grid = delay_grid,
                     .columns = transport_delay});
  library.push_back({.name = "current_loop_lag",
                     .cause = "a first-order lag between command and force",
                     .coefficients = {"time_constant_s"},
                     .scales = {"spacing_s"},
                     .first_is_positive = true,
                     .needs = "fast accelerations",
                     .grid = width_grid,
                     .columns = current_loop_lag});
  library.push_back({.name = "amplifier_gain",
                     .cause = "an amplifier gain other than stated",
                     .coefficients = {"relative_loss_ratio"},
                     .acts_on = ActsOn::kChain,
                     .needs = "a known mass or force, or a force channel",
                     .grid = no_scale,
                     .columns = amplifier_gain});
  library.push_back({.name = "amplifier_deadband",
                     .cause = "an amplifier that ignores small commands",
                     .coefficients = {"deadband_N"},
                     .first_is_positive = true,
                     .needs = "coasting and braking as well as driving",
                     .grid = no_scale,
                     .columns = amplifier_deadband});
  library.push_back({.name = "command_saturation",
                     .cause = "an amplifier that clips below the logged command",
                     .coefficients = {"clipped_share_ratio"},
                     .scales = {"level_ratio"},
                     .first_is_positive = true,
                     .first_by_law = 1,
                     .needs = "commands up to the limit",
                     .grid = clip_grid,
                     .columns = command_saturation});
  library.push_back({.name = "voltage_saturation",
                     .cause = "a supply too low for the force at speed",
                     .coefficients = {"clipped_share_ratio"},
                     .scales = {"stall_ratio"},
                     .first_is_positive = true,
                     .first_by_law = 1,
                     .needs = "large force at high speed",
                     .grid = stall_grid,
                     .columns = voltage_saturation});
  library.push_back({.name = "constant_bias",
                     .cause = "a constant force on the axis",
                     .coefficients = {"force_N"},
                     .needs = "motion in both directions",
                     .grid = no_scale,
                     .columns = constant_bias});
}

}  // namespace towbench::harness::diagnose
