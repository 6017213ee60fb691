#include "tests/study/diagnose/brought_case.h"

#include <algorithm>
#include <atomic>
#include <cmath>
#include <fstream>
#include <functional>
#include <vector>

#include <fmt/format.h>
#include <unistd.h>

namespace towbench::tests {
namespace {

namespace fs = std::filesystem;

// The axis's figures seen at the motor: M = J / r^2, B = B_m / r^2, C = C_m / r, F = K_T K V / r.
std::string plant_of(const HiddenAxis& axis) {
  const double r = 1 / (axis.motor_turns_per_m * 6.283185307179586);
  constexpr double kTorque_Nm_per_A = 26.7e-3;
  return fmt::format(
      "schema = 1\n[axis.y]\ninertia_kg_m2 = {:.12e}\nviscous_friction_Nm_s_per_rad = {:.12e}\n"
      "coulomb_friction_Nm = {:.12e}\ngear_ratio = {:.12f}\nsprocket_radius_m = {:.6f}\n"
      "torque_constant_Nm_per_A = {}\namplifier_gain_A_per_V = {:.12f}\npwm_amplitude_V = 10.0\n"
      "current_limit_A = 3.7\nencoder_counts_per_rev = {}\n",
      axis.mass_kg * r * r, axis.viscous_N_s_per_m * r * r, axis.coulomb_N * r,
      axis.output_radius_m / r, axis.output_radius_m, kTorque_Nm_per_A,
      axis.newton_per_duty_pct * 100 / 10 * r / kTorque_Nm_per_A,
      std::lround(axis.counts_per_m / axis.motor_turns_per_m));
}

}  // namespace

std::string rows_where(const std::string& csv, const std::function<bool(std::size_t)>& keeps) {
  std::string kept;
  std::size_t row = 0;
  for (std::size_t at = 0; at < csv.size(); ++row) {
    const std::size_t end = csv.find('\n', at) + 1;
    kept += row == 0 || keeps(row) ? csv.substr(at, end - at) : "";
    at = end;
  }
  return kept;
}

std::string csv_of(const HiddenAxis& axis, const HiddenLog& log) {
  std::string text =
      axis.open_loop ? "time_s,y_count,y_duty_pct\n" : "time_s,y_reference_m,y_count,y_duty_pct\n";
  for (std::size_t k = 0; k < log.time_s.size(); ++k) {
    text += fmt::format("{:.4f},", log.time_s[k]);
    text += axis.open_loop ? "" : fmt::format("{:.9f},", log.reference_m[k]);
    text += fmt::format("{:.0f},{:.4f}\n", std::floor(log.position_m[k] * axis.counts_per_m),
                        log.duty_pct[k]);
  }
  return text;
}

BroughtCase::BroughtCase(const HiddenAxis& axis) {
  static std::atomic<int> count{0};
  folder_ = fs::temp_directory_path() / fmt::format("brought_{}_{}", getpid(), count++);
  fs::create_directories(folder_);
  write("plant.toml", plant_of(axis));
}

BroughtCase::~BroughtCase() {
  std::error_code ignored;
  fs::remove_all(folder_, ignored);
}

fs::path BroughtCase::write(const std::string& name, const std::string& text) const {
  std::ofstream(folder_ / name, std::ios::binary) << text;
  return folder_ / name;
}

std::string BroughtCase::command(const std::string& arguments) const {
  return without_model("--model plant.toml " + arguments);
}

std::string BroughtCase::without_model(const std::string& arguments) const {
  return fmt::format("cd {} && exec {} diagnose --out found {}", folder_.string(),
                     quoted(TOWBENCH_STUDY), arguments);
}

ProgramOutput BroughtCase::diagnose_without_model(const std::string& arguments) const {
  return output_of(without_model(arguments));
}

ProgramOutput BroughtCase::diagnose(const std::string& arguments) const {
  return output_of(command(arguments));
}

nlohmann::json BroughtCase::answer() const {
  std::ifstream stream(out() / "diagnosis.json");
  return nlohmann::json::parse(stream, nullptr, false);
}

std::string names_in(const nlohmann::json& answer) {
  std::vector<std::string> names;
  const auto add = [&](std::string name, const nlohmann::json& others) {
    for (const auto& other : others) {
      name += "~" + other.get<std::string>();
    }
    names.push_back(std::move(name));
  };
  for (const auto& cause : answer.at("causes")) {
    add(cause.at("effect"), cause.at("indistinguishable_from"));
  }
  for (const auto& [name, shift] : answer.at("parameters").items()) {
    add(name, shift.at("indistinguishable_from"));
  }
  std::sort(names.begin(), names.end());
  return fmt::format("{}", fmt::join(names, " "));
}

}  // namespace towbench::tests
