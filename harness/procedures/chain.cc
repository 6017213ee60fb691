#include "harness/procedures/chain.h"

#include <algorithm>
#include <chrono>
#include <fstream>
#include <optional>

#include <fmt/format.h>

#include "harness/procedures/outcome_json.h"
#include "harness/record/line_writer.h"

namespace towbench::harness::procedures {
namespace {

std::filesystem::path kept_file(const ChainOptions& options, const Procedure& procedure,
                                core::Axis axis) {
  return options.out / "done" / fmt::format("{}-{}.json", core::name_of(axis), procedure.id());
}

std::optional<ProcedureOutcome> kept(const ChainOptions& options, const Procedure& procedure,
                                     core::Axis axis) {
  if (!options.resume || options.out.empty()) {
    return std::nullopt;
  }
  std::ifstream stream(kept_file(options, procedure, axis));
  if (!stream) {
    return std::nullopt;
  }
  try {
    const auto json = nlohmann::json::parse(stream);
    if (json.at("fingerprint") != options.fingerprint) {
      return std::nullopt;
    }
    return outcome_from_json(json.at("outcome"));
  } catch (const nlohmann::json::exception&) {
    return std::nullopt;  // torn or foreign: run again
  }
}

void keep(const ChainOptions& options, const ChainStep& step, const Procedure& procedure) {
  if (options.out.empty()) {
    return;
  }
  const auto path = kept_file(options, procedure, step.axis);
  std::filesystem::create_directories(path.parent_path());
  const nlohmann::json json{{"fingerprint", options.fingerprint},
                            {"outcome", to_json(step.outcome)}};
  write_atomically(path, json.dump());
}

ChainStep run_one(const Machine& machine, const Procedure& procedure, core::Axis axis,
                  const ChainOptions& options, const identify::Estimates& known) {
  ChainStep step{.id = std::string(procedure.id()), .title = std::string(procedure.title())};
  step.axis = axis;
  if (auto before = kept(options, procedure, axis)) {
    step.outcome = std::move(*before);
    step.from_before = true;
    return step;
  }
  const auto settings = options.settings / (step.id + ".toml");
  const auto what = fmt::format("{} {} ({})", step.id, procedure.title(), core::name_of(axis));
  const ProcedureContext context{
      .machine = machine,
      .axis = axis,
      .settings = !options.settings.empty() && std::filesystem::exists(settings)
                      ? settings
                      : std::filesystem::path{},
      .known = known,
      .progress = [&](double share) {
        if (options.progress) {
          options.progress(what, share);
        }
      }};
  context.tell(0);
  const auto start = std::chrono::steady_clock::now();
  const double simulated_s = machine.simulated_s();
  step.outcome = procedure.run(context);
  step.outcome.simulated_s = machine.simulated_s() - simulated_s;
  step.wall_s = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  keep(options, step, procedure);
  return step;
}

}  // namespace

ChainResult run_chain(const Machine& machine,
                      const std::vector<std::unique_ptr<Procedure>>& procedures,
                      const ChainOptions& options) {
  ChainResult result;
  for (const auto& procedure : procedures) {
    const auto& only = options.only;
    if (!only.empty() && std::find(only.begin(), only.end(), procedure->id()) == only.end()) {
      continue;
    }
    for (const auto axis : options.axes) {
      if (!machine.nameplate(axis).exists) {
        continue;
      }
      result.steps.push_back(run_one(machine, *procedure, axis, options, result.estimates));
      const auto& found = result.steps.back().outcome.estimates;
      result.estimates.insert(result.estimates.end(), found.begin(), found.end());
    }
  }
  return result;
}

}  // namespace towbench::harness::procedures
