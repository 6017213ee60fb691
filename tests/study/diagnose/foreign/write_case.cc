#include "tests/study/diagnose/foreign/write_case.h"

#include <algorithm>
#include <cmath>
#include <fstream>
#include <stdexcept>

#include <fmt/format.h>

namespace towbench::tests::foreign {
namespace {

void write(const std::filesystem::path& path, const std::string& text) {
  std::ofstream stream(path, std::ios::binary);
  stream << text;
  stream.close();
  if (!stream) {
    throw std::runtime_error("cannot write " + path.string());
  }
}

std::string log_of(const DrawnCase& one, const Recording& run) {
  const bool is_hand = run.plan.motion == "hand";
  const bool has_reference = !run.reference_m.empty();
  std::string text = fmt::format("time_s,position,input{}\n", has_reference ? ",reference" : "");
  for (std::size_t k = 0; k < run.position_m.size(); ++k) {
    text += fmt::format(
        "{:.6f},{:.9f},{:.7g}", run.plan.start_s + static_cast<double>(k) * one.machine.period_s,
        run.position_m[k],
        run.input_units[k] + (is_hand ? run.truth[k].hand_N / one.machine.newton_per_unit : 0));
    text += has_reference ? fmt::format(",{:.9f}\n", run.reference_m[k]) : "\n";
  }
  return text;
}

std::string truth_of(const Recording& run) {
  std::string text = "lacking_N,a_m_per_s2,v_m_per_s,dry,moving\n";
  for (std::size_t k = 0; k < run.truth.size(); ++k) {
    const Truth& t = run.truth[k];
    text += fmt::format("{:.6g},{:.6g},{:.6g},{:.4f},{:.3f}\n", t.lacking_N, t.a_m_per_s2,
                        t.v_m_per_s, t.dry, t.moving);
  }
  return text;
}

std::string map_of(const DrawnCase& one) {
  return fmt::format(
      "# of {0}\ntime = \"time_s\"\n"
      "position = \"position\"\nposition_scale_m = 1\ninput = \"input\"  # {1}\n"
      "input_scale_N = {2:.12g}\nrotary = {3}\n",
      one.machine.kind, one.machine.input, one.machine.newton_per_unit, one.machine.joint());
}

// Behind a gear of 100. Its motor limits nothing: at four times the top speed it still has no more
// than the supply's voltage against it.
std::string joint_of(const Machine& m, double stated_gravity) {
  constexpr double r = 0.01;
  constexpr double kSupply_V = 60;
  const double full_A = std::max(10.0, 4 * m.top_speed_m_per_s * m.limit_N() / kSupply_V);
  return fmt::format(
      "# joint: stroke {:.3f}, top speed {:.3f}, {:.0f} Hz\n"
      "schema = 1\n[supply]\nvoltage_V = {:.1f}\nover_current_A = {:.1f}\n"
      "[axis.y]\ninertia_kg_m2 = {:.9g}\nviscous_friction_Nm_s_per_rad = {:.9g}\n"
      "coulomb_friction_Nm = {:.9g}\ntorque_constant_Nm_per_A = {:.9g}\n"
      "amplifier_gain_A_per_V = {:.9g}\npwm_amplitude_V = 10.0\ncurrent_limit_A = {:.9g}\n"
      "encoder_counts_per_rev = {:.0f}\n"
      "[axis.y.transmission]\nkind = \"gear\"\ngear_ratio = {:.1f}\n"
      "[axis.y.disturbances.gravity]\ntorque_Nm = {:.9g}\nzero_at_deg = {:.9g}\n",
      m.stroke_m, m.top_speed_m_per_s, 1 / m.period_s, kSupply_V, 3 * full_A, m.mass_kg * r * r,
      m.viscous_N_s_per_m * r * r, m.coulomb_N * r, m.limit_N() * r / full_A, full_A / 10, full_A,
      std::max(4.0, 4 * std::round(kTurn * r / m.metres_per_count / 4)), 1 / r,
      stated_gravity * m.gravity_N, m.gravity_at_rad * 360 / kTurn);
}

constexpr double kDirect_m = 0.005;  // a radian of no motor: of at most 1,000,000 counts a metre

// Where the motor's turn is not of a wheel, the table of a screw follows what else is stated.
std::string wheel_of(const Machine& m) {
  if (m.sprocket_radius_m > 0) {
    return fmt::format("gear_ratio = {:.9g}\nsprocket_radius_m = {:.9g}\n",
                       m.sprocket_radius_m / m.metres_per_motor_rad, m.sprocket_radius_m);
  }
  return m.metres_per_motor_rad > 0 ? "" : fmt::format("sprocket_radius_m = {}\n", kDirect_m);
}

std::string screw_of(const Machine& m) {
  if (m.sprocket_radius_m > 0 || m.metres_per_motor_rad == 0) return "";
  return fmt::format("[axis.y.transmission]\nkind = \"screw\"\ngear_ratio = 1.0\nlead_m = {:.9g}\n",
                     kTurn * m.metres_per_motor_rad);
}

// Load-side form; what it has no key for stands as a comment.
std::string plant_of(const Machine& m) {
  std::string text = fmt::format(
      "# {}: stroke {:.3f}, top speed {:.3f}, {:.0f} Hz\n"
      "schema = 1\n[axis.y]\nmass_kg = {:.9g}\nviscous_friction_N_s_per_m = {:.9g}\n"
      "coulomb_friction_N = {:.9g}\nforce_gain_N_per_V = {:.9g}\npwm_amplitude_V = 10.0\n"
      "encoder_counts_per_m = {:.9g}\n",
      m.kind, m.stroke_m, m.top_speed_m_per_s, 1 / m.period_s, m.mass_kg, m.viscous_N_s_per_m,
      m.coulomb_N, m.limit_N() / 10, 1 / m.metres_per_count);
  text += wheel_of(m);
  if (m.chain_Hz > 0) {
    text += fmt::format("rotor_inertia_kg_m2 = {:.9g}\n",
                        m.motor_share * m.mass_kg * std::pow(m.metres_per_motor_rad, 2));
    text += fmt::format(
        "[axis.y.elasticity]\nresonance_Hz = {:.9g}\ndamping_ratio = {:.6g}\n"
        "[axis.y.friction]\ncarriage_share = {:.6g}\n",
        m.chain_Hz, m.chain_damping, m.load_friction);
  }
  return text + screw_of(m);
}

}  // namespace

void write_case(const DrawnCase& one, const std::filesystem::path& folder) {
  std::filesystem::create_directories(folder);
  write(folder / "map.toml", map_of(one));
  write(folder / "plant.toml", one.machine.joint()
                                   ? joint_of(one.machine, one.runs.front().stated_gravity)
                                   : plant_of(one.machine));
  std::string told = fmt::format("seed {}\nplan {}\nreference {}\nloop {:.3f} Hz, damping {:.2f}\n",
                                 one.seed, one.plan.words(), one.plan.with_reference,
                                 one.plan.loop.bandwidth_Hz, one.plan.loop.damping);
  for (const Hidden& hidden : one.hidden) {
    told += fmt::format("hidden {} strength {:.4g} draw {:.4f} place {:.4f} sign {}\n", hidden.name,
                        hidden.strength, hidden.draw, hidden.place, hidden.sign);
  }
  told += fmt::format("visible {:.2f} times, {:.2f} % of the command; {} draws before\n",
                      one.visible, 100 * one.share, one.redrawn);
  for (std::size_t i = 0; i < one.runs.size(); ++i) {
    const Recording& run = one.runs[i];
    const std::string name =
        fmt::format("{}_{}{}", i + 1, run.plan.motion, run.plan.held_out ? "_held_out" : "");
    write(folder / (name + ".csv"), log_of(one, run));
    write(folder / (name + ".truth.csv"), truth_of(run));
    const Session& session = one.plan.sessions[run.plan.session];
    told += fmt::format("run {} session {} from {:.1f} s: offset {:.4g} N, friction {:.3f}\n", name,
                        run.plan.session, run.plan.start_s, session.offset_N, session.friction);
  }
  write(folder / "told.txt", told);
}

}  // namespace towbench::tests::foreign
