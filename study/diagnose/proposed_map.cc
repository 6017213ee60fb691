#include "study/diagnose/proposed_map.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>
#include <sstream>
#include <string_view>
#include <utility>

#include <fmt/format.h>
#include <toml++/toml.h>

#include "study/diagnose/column_guess.h"
#include "study/statistics/statistics.h"

namespace towbench::study::diagnose {
namespace {

const ColumnGuess* of_role(const std::vector<ColumnGuess>& guesses, Role role) {
  const auto found = std::find_if(guesses.begin(), guesses.end(),
                                  [&](const ColumnGuess& g) { return g.role == role; });
  return found == guesses.end() ? nullptr : &*found;
}

double median_step(const std::vector<double>& time) {
  std::vector<double> steps;
  for (std::size_t i = 1; i < time.size(); ++i) {
    if (std::isfinite(time[i] - time[i - 1])) steps.push_back(time[i] - time[i - 1]);
  }
  return steps.empty() ? 0 : statistics::median(std::move(steps));
}

// By the unit's name, else the one that makes a period of 5 us to 0.1 s.
double seconds_a_unit(const std::string& unit, double step) {
  static const std::map<std::string, double> kSeconds{
      {"s", 1}, {"ms", 1e-3}, {"us", 1e-6}, {"ns", 1e-9}};
  if (const auto known = kSeconds.find(unit); known != kSeconds.end()) return known->second;
  constexpr double kLongestPeriod_s = 0.1;
  double scale = 1;
  while (step * scale > kLongestPeriod_s && scale > 1e-9) scale *= 1e-3;
  return scale;
}

// Metres, or radians, a unit; 0: the name does not say.
double length_a_unit(const std::string& unit) {
  static const std::map<std::string, double> kLengths{
      {"m", 1},   {"mm", 1e-3},   {"um", 1e-6},
      {"rad", 1}, {"mrad", 1e-3}, {"deg", std::numbers::pi / 180}};
  const auto known = kLengths.find(unit);
  return known == kLengths.end() ? 0 : known->second;
}

bool turns(const ColumnGuess* position, const ColumnGuess* input) {
  const auto is = [](const ColumnGuess* g, std::initializer_list<std::string_view> units) {
    return g != nullptr && std::find(units.begin(), units.end(), g->unit) != units.end();
  };
  return is(position, {"rad", "mrad", "deg"}) || is(input, {"Nm"});
}

bool counts(const ColumnGuess& position) {
  return position.unit == "count" || position.unit == "counts";
}

struct Found {
  std::vector<ColumnGuess> all;
  const ColumnGuess* time;
  const ColumnGuess* position;
  const ColumnGuess* reference;
  const ColumnGuess* input;
  double step = 0;  // of the time, in its unit
  bool rotary = false;

  explicit Found(const logs::Table& table)
      : all(guess_columns(table)),
        time(of_role(all, Role::kTime)),
        position(of_role(all, Role::kPosition)),
        reference(of_role(all, Role::kReference)),
        input(of_role(all, Role::kInput)),
        rotary(turns(position, input)) {
    if (time != nullptr) step = median_step(*table.find(time->name));
  }
  [[nodiscard]] double seconds() const { return seconds_a_unit(time->unit, step); }
  [[nodiscard]] const char* length() const { return rotary ? "radians" : "metres"; }
  [[nodiscard]] const char* force() const { return rotary ? "newton metres" : "newtons"; }
  [[nodiscard]] bool force_is_known() const {
    return input != nullptr && (input->unit == "N" || input->unit == "Nm");
  }
};

// A header may hold what TOML writes otherwise.
std::string quoted(const std::string& name) {
  std::ostringstream text;
  text << toml::toml_formatter{
      toml::value<std::string>(name),
      toml::toml_formatter::default_flags & ~toml::format_flags::allow_literal_strings};
  return text.str();
}

std::string line(const char* key, const ColumnGuess* column) {
  return column != nullptr ? fmt::format("{} = {}\n", key, quoted(column->name))
                           : fmt::format("# {} = \"\"  which column is it?\n", key);
}

std::string other_of(const ColumnGuess& g) {
  const double scale = length_a_unit(g.unit);
  std::string out = "[[other]]\n" + line("position", &g);
  if (scale == 0) out += "# position_scale_m = 1.0  metres or radians a unit\n";
  if (scale != 0 && scale != 1) out += fmt::format("position_scale_m = {:.10g}\n", scale);
  return out + (turns(&g, nullptr) ? "rotary = true\n" : "# rotary = true  if it is a joint\n");
}

std::string map_of(const Found& f) {
  std::string out = line("time", f.time);
  if (f.time != nullptr && f.seconds() != 1) {
    out += fmt::format("time_scale_s = {:g}\n", f.seconds());
  }
  out += line("position", f.position);
  if (f.position != nullptr) {
    const double scale = length_a_unit(f.position->unit);
    if (counts(*f.position)) out += "position_is_count = true\n";
    if (scale == 0) {
      out += fmt::format("# position_scale_m = 1.0  {} a unit\n", f.length());
    } else if (scale != 1) {
      out += fmt::format("position_scale_m = {:.10g}\n", scale);
    }
  }
  out += line("input", f.input);
  if (!f.force_is_known()) out += fmt::format("# input_scale_N = 1.0  {} a unit\n", f.force());
  if (f.reference != nullptr) out += line("reference", f.reference);
  out += of_role(f.all, Role::kTemperature) != nullptr
             ? line("temperature", of_role(f.all, Role::kTemperature))
             : std::string{};
  if (f.rotary) out += "rotary = true\n";
  for (const ColumnGuess& g : f.all) {
    if (g.role == Role::kOther) out += other_of(g);
  }
  return out;
}

std::string columns_of(const Found& f) {
  static const std::map<Role, const char*> kRoles{
      {Role::kNone, "not used"},       {Role::kTime, "time"},
      {Role::kPosition, "position"},   {Role::kInput, "input"},
      {Role::kReference, "reference"}, {Role::kVelocity, "not used"},
      {Role::kOther, "another axis"},  {Role::kTemperature, "temperature"}};
  std::size_t width = 0;
  for (const ColumnGuess& g : f.all) width = std::max(width, g.name.size());
  std::string out;
  for (const ColumnGuess& g : f.all) {
    out += fmt::format("  {:<{}}  {:>10.4g} .. {:<10.4g}  {}{}{}\n", g.name, width, g.low, g.high,
                       kRoles.at(g.role), g.why.empty() ? "" : ": ", g.why);
  }
  return out;
}

std::string to_be_told(const Found& f) {
  std::string out;
  if (f.position != nullptr && length_a_unit(f.position->unit) == 0) {
    out += fmt::format("  position_scale_m: {} that '{}' moves by one unit{}\n", f.length(),
                       f.position->name, counts(*f.position) ? ", which is a count" : "");
  }
  if (f.input != nullptr && !f.force_is_known()) {
    out += fmt::format(
        "  input_scale_N: {} that one unit of '{}' makes; without it masses and forces are in its "
        "unit\n",
        f.force(), f.input->name);
  }
  if (!f.rotary) out += "  rotary = true, if it is a joint\n";
  out +=
      "  input_hold = false, if the input acts when it is logged and is not held until the next\n";
  return out;
}

}  // namespace

std::string proposed_map(const logs::Table& table) {
  return map_of(Found(table));
}

std::string explain_columns(const logs::Table& table, const std::string& file) {
  const Found f(table);
  std::string out = fmt::format("{}: {} rows, {} columns", file, table.rows(), table.names.size());
  if (f.time != nullptr && f.step > 0)
    out += fmt::format(", {:.4g} Hz", 1 / (f.step * f.seconds()));
  out += ".\n" + columns_of(f);
  out += "\nA map, to be saved and corrected:\n\n" + map_of(f);
  out += "\nWhat no log says:\n" + to_be_told(f);
  return out +
         "\nMass, friction and offset are estimated; with --model FILE they are compared with a "
         "plant file.\n";
}

}  // namespace towbench::study::diagnose
