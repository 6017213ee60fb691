#include "harness/commands/verdict_table.h"

#include <cmath>
#include <string>
#include <vector>

#include <fmt/format.h>
#include <fmt/ranges.h>

namespace towbench::harness {
namespace {

std::string limits_of(const Check& check) {
  if (check.min && check.max) {
    return fmt::format("{} .. {}", with_unit(*check.min, check.unit),
                       with_unit(*check.max, check.unit));
  }
  if (check.min) {
    return ">= " + with_unit(*check.min, check.unit);
  }
  return check.max ? "<= " + with_unit(*check.max, check.unit) : std::string{};
}

std::string margin_text(const Check& check) {
  if (!check.margin || !std::isfinite(*check.margin)) {
    return {};
  }
  // An exact value has no margin, and one against zero no scale.
  const bool exact = check.min && check.max && *check.min == *check.max;
  const bool no_scale = check.min.value_or(0) == 0 && check.max.value_or(0) == 0;
  return exact || no_scale ? std::string{} : fmt::format("{:.0f} %", 100.0 * *check.margin);
}

std::string line_of(const Check& check) {
  const auto name = check.window.empty() || check.window == "whole"
                        ? check.name
                        : check.name + " @" + check.window;
  auto line = fmt::format("  {:<7}  {:<44} {:>12}  {:<24} {:>6}", name_of(check.verdict), name,
                          check.value ? with_unit(*check.value, check.unit) : "", limits_of(check),
                          margin_text(check));
  line.erase(line.find_last_not_of(' ') + 1);
  if (!check.reason.empty()) {
    line += "\n           " + check.reason;
  }
  return line + "\n";
}

// What an INVALID must not hide.
std::string also_failed(const Judgement& judgement) {
  std::vector<std::string> failed;
  for (const auto& check : judgement.checks) {
    if (judgement.verdict == Verdict::kInvalid && check.verdict == Verdict::kFail) {
      failed.push_back(check.name);
    }
  }
  return failed.empty() ? std::string{}
                        : fmt::format("         and FAIL: {}\n", fmt::join(failed, ", "));
}

}  // namespace

std::string with_unit(double value, const std::string& unit) {
  const double size = std::fabs(value);
  const bool scales =
      unit == "m" || unit == "s" || unit == "m/s" || unit == "rad" || unit == "rad/s";
  if (scales && size > 0 && size < 1e-3) {
    return fmt::format("{:.4g} u{}", value * 1e6, unit);
  }
  if (scales && size > 0 && size < 1) {
    return fmt::format("{:.4g} m{}", value * 1e3, unit);
  }
  return unit.empty() ? fmt::format("{:.7g}", value) : fmt::format("{:.4g} {}", value, unit);
}

std::string verdict_table(const std::string& experiment, const RunResult& run, bool all) {
  if (!run.complete) {
    return fmt::format("INCOMPLETE  {}: {}\n", experiment, run.reason);
  }
  auto text = fmt::format("{:<7}  {}   ({:.3g} s in {:.2g} s, {:.0f} x real time)\n",
                          name_of(run.judgement.verdict), experiment,
                          core::seconds(run.outcome.end_ns), run.outcome.wall_time_s,
                          core::seconds(run.outcome.end_ns) / run.outcome.wall_time_s);
  if (!run.judgement.judged.empty()) {
    text += "         " + run.judgement.judged + "\n";
  }
  text += also_failed(run.judgement);
  for (const auto& check : run.judgement.checks) {
    if (all || check.verdict != Verdict::kPass) {
      text += line_of(check);
    }
  }
  return text;
}

}  // namespace towbench::harness
