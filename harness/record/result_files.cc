#include "harness/record/result_files.h"

#include <cmath>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "harness/checks/recorded_axes.h"
#include "harness/fixtures/canonical_hash.h"
#include "harness/record/junit.h"
#include "harness/record/line_writer.h"
#include "harness/record/machine.h"

namespace towbench::harness {
namespace {

using nlohmann::json;

json or_null(const std::optional<double>& value) {
  return value ? json(*value) : json(nullptr);
}

json image_json(const ImageIdentity& image) {
  return {{"file", image.copy.string()},
          {"name", image.name},
          {"bytes", image.bytes},
          {"sha256", image.sha256}};
}

json head(const ExperimentFixture& fixture, const RunIdentity& identity) {
  const auto& experiment = fixture.experiment;
  json result = {{"schema", 1},
                 {"status", "incomplete"},
                 {"reason", "the run has not finished: it is under way or was killed"},
                 {"experiment",
                  {{"name", experiment.name},
                   {"title", experiment.title},
                   {"description", experiment.description},
                   {"file", identity.experiment_copy.string()}}},
                 {"clock", identity.clock},
                 {"carrier", identity.carrier},
                 {"fidelity", identity.fidelity},
                 {"seed", identity.seed},
                 {"version", TOWBENCH_VERSION},
                 {"hashes",
                  {{"rig", hash_text(fixture.rig.hash)},
                   {"controller", hash_text(fixture.controller.hash)},
                   {"experiment", hash_text(fixture.hash)}}},
                 {"machine", describe_machine()},
                 {"started_utc", identity.started_utc}};
  if (identity.image) {
    result["image"] = image_json(*identity.image);
  }
  return result;
}

json limits_json(const emulator::RigParameters& rig) {
  const auto limits = limits_of(rig);
  json object = json::object();
  for (const auto axis : recorded_axes(limits)) {
    const auto& ends = limits[axis];
    object[std::string(core::name_of(axis))] = {
        {"exists", ends.exists},         {"hall_min_m", ends.hall_min_m},
        {"hall_max_m", ends.hall_max_m}, {"hard_min_m", ends.hard_min_m},
        {"hard_max_m", ends.hard_max_m}, {"metres_per_count", ends.metres_per_count}};
    if (ends.turns) {
      object[std::string(core::name_of(axis))]["turns"] = true;
    }
  }
  return object;
}

void add_outcome(json& result, const ExperimentFixture& fixture, const RunOutcome& outcome) {
  const double simulated_s = core::seconds(outcome.end_ns);
  result["simulated_time_s"] = simulated_s;
  result["wall_time_s"] = outcome.wall_time_s;
  result["real_time_factor"] = outcome.wall_time_s > 0 ? simulated_s / outcome.wall_time_s : 0.0;
  const auto exchanges =
      outcome.exchange_ns > 0 ? outcome.end_ns / outcome.exchange_ns : core::Nanoseconds{0};
  result["rows"] = {{"log", outcome.log_rows}, {"truth", exchanges}, {"lost", outcome.rows_lost}};
  result["limits"] = limits_json(fixture.rig.parameters);
}

json check_json(const Check& check) {
  return {{"name", check.name},
          {"window", check.window},
          {"meaning", check.meaning},
          {"value", or_null(check.value)},
          {"unit", check.unit},
          {"min", or_null(check.min)},
          {"max", or_null(check.max)},
          {"margin", or_null(check.margin)},
          {"verdict", name_of(check.verdict)},
          {"reason", check.reason},
          {"source", check.source}};
}

json metrics_json(const Judgement& judgement, double end_s) {
  json windows = json::array();
  for (const auto& window : judgement.windows) {
    windows.push_back({{"name", window.name},
                       {"from_s", std::max(0.0, window.span.from_s)},
                       {"to_s", std::min(end_s, window.span.to_s)}});
  }
  json metrics = json::array();
  for (const auto& measurement : judgement.measurements) {
    const bool known = measurement.value.samples > 0;
    metrics.push_back({{"name", measurement.metric->name},
                       {"window", measurement.window},
                       {"value", known ? json(measurement.value.value) : json(nullptr)},
                       {"unit", measurement.unit},
                       {"samples", measurement.value.samples},
                       {"meaning", measurement.metric->meaning}});
  }
  return {{"schema", 1}, {"windows", windows}, {"metrics", metrics}};
}

// One column a requirement, empty where it demands nothing.
void write_margins(const std::filesystem::path& path, const Judgement& judgement) {
  std::string text = "time_s";
  for (const auto& requirement : judgement.requirements) {
    text += ',' + requirement.check.name;
  }
  for (std::size_t i = 0; i < judgement.time_s.size(); ++i) {
    text += fmt::format("\n{}", judgement.time_s[i]);
    for (const auto& requirement : judgement.requirements) {
      const double margin = requirement.robustness.over_time[i];
      text += std::isfinite(margin) ? fmt::format(",{}", margin) : ",";
    }
  }
  write_atomically(path, text + '\n');
}

void write_json(const std::filesystem::path& path, const json& value) {
  constexpr int kIndent = 2;
  write_atomically(path, value.dump(kIndent, ' ', false, json::error_handler_t::replace) + "\n");
}

}  // namespace

void write_started(const std::filesystem::path& folder, const ExperimentFixture& fixture,
                   const RunIdentity& identity) {
  write_json(folder / "result.json", head(fixture, identity));
}

void write_incomplete(const std::filesystem::path& folder, const ExperimentFixture& fixture,
                      const RunIdentity& identity, const RunOutcome& outcome) {
  auto result = head(fixture, identity);
  result["reason"] = outcome.reason;
  result["exit_code"] = kExitRuntime;
  add_outcome(result, fixture, outcome);
  write_json(folder / "result.json", result);
}

void write_judged(const std::filesystem::path& folder, const ExperimentFixture& fixture,
                  const RunIdentity& identity, const RunOutcome& outcome,
                  const Judgement& judgement) {
  auto result = head(fixture, identity);
  result["status"] = "complete";
  result["reason"] = "";
  result["verdict"] = name_of(judgement.verdict);
  result["exit_code"] = exit_code_of(judgement.verdict);
  result["judged"] = judgement.judged;
  add_outcome(result, fixture, outcome);
  result["checks"] = json::array();
  for (const auto& check : judgement.checks) {
    result["checks"].push_back(check_json(check));
  }
  if (!judgement.requirements.empty()) {
    write_margins(folder / "margins.csv", judgement);
  }
  write_json(folder / "metrics.json", metrics_json(judgement, core::seconds(outcome.end_ns)));
  write_atomically(folder / "junit.xml",
                   junit_xml(fixture.experiment.name, outcome.wall_time_s, judgement.checks));
  write_json(folder / "result.json", result);
}

}  // namespace towbench::harness
