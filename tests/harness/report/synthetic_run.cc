#include "tests/harness/report/synthetic_run.h"

#include <algorithm>
#include <cmath>
#include <fstream>
#include <iterator>
#include <numbers>

#include <fmt/format.h>

#include "harness/proof/run_manifest.h"

namespace towbench::harness::test {
namespace {

using Json = nlohmann::json;

constexpr double kRadius_m = 0.2;
constexpr double kTurn_s = 7.0;
constexpr double kStart_s = 1.0;
constexpr double kMetresPerCount = 2.2e-6;

double phase(std::size_t row) {
  const double time_s = static_cast<double>(row) * 1e-3;
  return time_s < kStart_s ? 0 : 2 * std::numbers::pi * (time_s - kStart_s) / kTurn_s;
}

struct AxisRow {
  double reference_m, reference_m_per_s, position_m, velocity_m_per_s, duty_pct, carriage_m;
  long count;
  int edges;
};

AxisRow axis_row(const SyntheticRun& run, std::size_t row, double shift_turns) {
  const double angle = phase(row) + 2 * std::numbers::pi * shift_turns;
  const double rate = phase(row) > 0 ? 2 * std::numbers::pi / kTurn_s : 0;
  AxisRow a{};
  a.reference_m = kRadius_m * std::sin(angle);
  a.reference_m_per_s = kRadius_m * rate * std::cos(angle);
  const double error_m = run.error_peak_m * std::sin(3 * angle);
  a.count = std::lround((a.reference_m - error_m) / kMetresPerCount);
  a.position_m = (static_cast<double>(a.count) + 0.5) * kMetresPerCount;
  a.velocity_m_per_s = a.reference_m_per_s * 1.01;
  a.duty_pct = 12 * std::cos(angle) + (std::cos(angle) > 0 ? 2 : -2);
  a.carriage_m = a.position_m - 6e-4 * std::sin(angle);
  a.edges = static_cast<int>(std::fabs(a.reference_m_per_s) / kMetresPerCount * 1e-3);
  return a;
}

constexpr int kFollowing = 2;

int state_in(const SyntheticRun& run, std::size_t row) {
  return row < 100 ? 0 : row + 300 > run.rows ? 4 : kFollowing;
}

std::string log_text(const SyntheticRun& run) {
  std::string text = "time_s";
  for (const char axis : {'y', 'x'}) {
    for (const char* name : {"reference_m", "reference_velocity_m_per_s", "count", "position_m",
                             "velocity_m_per_s", "duty_pct", "state", "edges"}) {
      text += fmt::format(",{}_{}", axis, name);
    }
  }
  text += ",fault\n";
  for (std::size_t row = 0; row < run.rows; ++row) {
    text += fmt::format("{}", static_cast<double>(row) * 1e-3);
    for (const double shift : {0.0, 0.25}) {
      const AxisRow a = axis_row(run, row, shift);
      text +=
          fmt::format(",{},{},{},{},{},{},{},{}", a.reference_m, a.reference_m_per_s, a.count,
                      a.position_m, a.velocity_m_per_s, a.duty_pct, state_in(run, row), a.edges);
    }
    text += ",0\n";
  }
  return text;
}

std::string truth_text(const SyntheticRun& run) {
  std::string text =
      "time_s,y_carriage_m,y_carriage_speed_m_per_s,y_current_A,x_carriage_m,x_carriage_speed_m_"
      "per_"
      "s,x_current_A,input_lines\n";
  for (std::size_t row = 0; row < run.rows; ++row) {
    const AxisRow y = axis_row(run, row, 0.0);
    const AxisRow x = axis_row(run, row, 0.25);
    text += fmt::format("{},{},{},{},{},{},{},0\n", static_cast<double>(row) * 1e-3, y.carriage_m,
                        y.reference_m_per_s, y.duty_pct * 0.05, x.carriage_m, x.reference_m_per_s,
                        x.duty_pct * 0.05);
  }
  return text;
}

std::string events_text(const SyntheticRun& run) {
  Json started = {{"time_s", 1.0}, {"side", "controller"}, {"kind", "mode_changed"}, {"axis", "y"}};
  Json index = {{"time_s", 1.5}, {"side", "plant"}, {"kind", "index_pulse"}, {"axis", "y"}};
  Json fault = {{"time_s", 8.2}, {"side", "controller"}, {"kind", "fault"},
                {"axis", "y"},   {"code", 303},          {"text", run.event_text}};
  return started.dump() + "\n" + index.dump() + "\n" + fault.dump() + "\n";
}

double error_peak_in(const SyntheticRun& run) {
  double peak_m = 0;
  for (std::size_t row = 0; row < run.rows; ++row) {
    if (state_in(run, row) != kFollowing) {
      continue;
    }
    const AxisRow y = axis_row(run, row, 0.0);
    peak_m = std::max(peak_m, std::fabs(y.reference_m - y.position_m));
  }
  return peak_m;
}

Json metric(const SyntheticRun& run) {
  return {{"name", "y_tracking_error_peak_m"},
          {"window", "whole"},
          {"value", error_peak_in(run)},
          {"unit", "m"},
          {"samples", run.rows},
          {"meaning", "largest distance between reference and position"}};
}

std::string timing_text(const SyntheticRun& run) {
  std::string text = "time_s,host_s,exchange_us\n";
  for (std::size_t row = 0; row < run.rows; ++row) {
    const double slow = row % 1000 == 0 ? 40.0 : 0.0;
    text +=
        fmt::format("{},{},{}\n", static_cast<double>(row) * 1e-3, static_cast<double>(row) * 2e-6,
                    1.5 + slow + 0.01 * static_cast<double>(row % 97));
  }
  return text;
}

}  // namespace

Json synthetic_result(const SyntheticRun& run) {
  const double seconds = static_cast<double>(run.rows) * 1e-3;
  Json check = metric(run);
  check.erase("samples");
  check.update({{"min", nullptr},
                {"max", 1e-3},
                {"margin", 1 - error_peak_in(run) / 1e-3},
                {"verdict", "PASS"},
                {"reason", ""},
                {"source", "TRK-7: circle"}});
  const Json seen = {
      {"name", "edges_seen"}, {"window", ""},      {"meaning", "the decoder saw edges"},
      {"value", nullptr},     {"unit", ""},        {"min", nullptr},
      {"max", nullptr},       {"margin", nullptr}, {"verdict", "PASS"},
      {"reason", ""},         {"source", ""}};
  return {{"schema", 1},
          {"status", "complete"},
          {"reason", ""},
          {"verdict", "PASS"},
          {"exit_code", 0},
          {"experiment",
           {{"name", "circle"},
            {"title", run.title},
            {"description", run.description},
            {"file", "inputs/experiments/circle.toml"}}},
          {"clock", "lockstep"},
          {"carrier", "in-process"},
          {"fidelity", "edges"},
          {"seed", 1},
          {"version", "0.1.0"},
          {"hashes", {{"rig", "9f86d081884c7d65"}, {"controller", "60303ae22b998861"}}},
          {"machine", {{"system", "Linux 6.1.0"}, {"cores", 2}}},
          {"started_utc", "2025-01-31T12:00:00Z"},
          {"simulated_time_s", seconds},
          {"wall_time_s", 0.02},
          {"real_time_factor", seconds / 0.02},
          {"rows", {{"log", run.rows}, {"truth", run.rows}, {"lost", 0}}},
          {"limits",
           {{"y",
             {{"hall_min_m", -0.21},
              {"hall_max_m", 3.9},
              {"hard_min_m", -0.255},
              {"hard_max_m", 3.945},
              {"metres_per_count", kMetresPerCount}}}}},
          {"checks", Json::array({check, seen})}};
}

SyntheticRow synthetic_y(const SyntheticRun& run, std::size_t row) {
  const AxisRow a = axis_row(run, row, 0.0);
  return {static_cast<double>(row) * 1e-3, a.reference_m, a.position_m, a.carriage_m};
}

void write_synthetic_run(const std::filesystem::path& folder, const SyntheticRun& run) {
  write_synthetic_run(folder, run, synthetic_result(run));
}

void write_synthetic_run(const std::filesystem::path& folder, const SyntheticRun& run,
                         const Json& result) {
  const double end_s = static_cast<double>(run.rows) * 1e-3;
  std::filesystem::create_directories(folder);
  write_text(folder / "result.json", result.dump(2, ' ', false, Json::error_handler_t::replace));
  write_text(folder / "metrics.json", Json{{"schema", 1},
                                           {"windows",
                                            {{{"name", "whole"}, {"from_s", 0.0}, {"to_s", end_s}},
                                             {{"name", "steady"}, {"from_s", 2.0}, {"to_s", 6.0}}}},
                                           {"metrics", Json::array({metric(run)})}}
                                          .dump(2));
  write_text(folder / "log.csv", log_text(run));
  write_text(folder / "truth.csv", truth_text(run));
  write_text(folder / "timing.csv", timing_text(run));
  write_text(folder / "events.jsonl", events_text(run));
  write_text(folder / "console.txt", run.console);
  write_manifest(folder);
}

std::string read_text(const std::filesystem::path& path) {
  std::ifstream file(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(file), {}};
}

void write_text(const std::filesystem::path& path, const std::string& text) {
  std::ofstream(path, std::ios::binary) << text;
}

}  // namespace towbench::harness::test
