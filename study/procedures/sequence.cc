#include "study/procedures/sequence.h"

#include <algorithm>
#include <chrono>
#include <functional>
#include <optional>

#include <fmt/format.h>

#include "study/procedures/kept_outcome.h"
#include "study/procedures/outcome_json.h"

namespace towbench::study::procedures {
namespace {

std::filesystem::path kept_file(const SequenceOptions& options, const Procedure& procedure,
                                core::Axis axis) {
  return options.out / "done" / fmt::format("{}-{}.json", core::name_of(axis), procedure.id());
}

std::optional<ProcedureOutcome> kept(const SequenceOptions& options,
                                     const std::filesystem::path& file,
                                     const std::string& fingerprint) {
  if (!options.resume || options.out.empty()) {
    return std::nullopt;
  }
  try {
    const auto json = kept_outcome(file, fingerprint);
    return json ? std::optional(outcome_from_json(*json)) : std::nullopt;
  } catch (const nlohmann::json::exception&) {
    return std::nullopt;
  }
}

SequenceStep run_one(const Machine& machine, const Procedure& procedure, core::Axis axis,
                     const SequenceOptions& options, const identify::Estimates& known) {
  SequenceStep step{.id = std::string(procedure.id()), .title = std::string(procedure.title())};
  step.axis = axis;
  const auto settings = options.settings / (step.id + ".toml");
  // What it was found with: this program, machine, settings, and what was known before.
  const auto fingerprint =
      fmt::format("{}-{}-{}-{:016x}", program_fingerprint(), options.fingerprint,
                  file_fingerprint(options.settings.empty() ? options.settings : settings),
                  std::hash<std::string>{}(identify::to_json(known).dump()));
  const auto file = kept_file(options, procedure, axis);
  if (auto before = kept(options, file, fingerprint)) {
    step.outcome = std::move(*before);
    step.from_before = true;
    return step;
  }
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
  // A failed one may have been interrupted: it is tried again.
  if (!options.out.empty() && step.outcome.status != ProcedureOutcome::Status::kFailed) {
    keep_outcome(file, fingerprint, to_json(step.outcome));
  }
  return step;
}

}  // namespace

SequenceResult run_sequence(const Machine& machine,
                            const std::vector<std::unique_ptr<Procedure>>& procedures,
                            const SequenceOptions& options) {
  SequenceResult result;
  for (const auto& procedure : procedures) {
    const auto& only = options.only;
    if (!only.empty() && std::find(only.begin(), only.end(), procedure->id()) == only.end()) {
      continue;
    }
    for (const auto axis : options.axes) {
      if (!machine.nameplate(axis).exists) {
        continue;
      }
      if (options.stop != nullptr && options.stop->load()) {
        return result;
      }
      result.steps.push_back(run_one(machine, *procedure, axis, options, result.estimates));
      const auto& found = result.steps.back().outcome.estimates;
      result.estimates.insert(result.estimates.end(), found.begin(), found.end());
    }
  }
  return result;
}

}  // namespace towbench::study::procedures
