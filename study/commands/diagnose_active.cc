#include "study/commands/diagnose_active.h"

#include <cstddef>
#include <cstdio>
#include <fstream>

#include "harness/checks/check.h"
#include "harness/commands/experiment_options.h"
#include "study/active/active_report.h"
#include "study/diagnose/known_force.h"

namespace towbench::study {
namespace {

// Multiplies a value, a `{ value = ... }` or a list of values, where the file has the key.
void scale(toml::table& table, const char* key, double by) {
  toml::node* node = table.get(key);
  if (node != nullptr && node->is_table()) {
    node = node->as_table()->get("value");
  }
  if (node == nullptr) {
    return;
  }
  if (auto* list = node->as_array()) {
    for (std::size_t i = 0; i < list->size(); ++i) {
      list->replace(list->cbegin() + static_cast<std::ptrdiff_t>(i),
                    list->get(i)->value_or(0.0) * by);
    }
  } else if (const auto value = node->value<double>()) {
    table.get(key)->is_table() ? table.get(key)->as_table()->insert_or_assign("value", *value * by)
                               : table.insert_or_assign(key, *value * by);
  }
}

// Everything that resists a command; a transmission keeps its mode and so gets stiffer alike.
void scale_everything_else(toml::table& axis, double by) {
  for (const char* key :
       {"inertia_kg_m2", "rotor_inertia_kg_m2", "viscous_friction_Nm_s_per_rad",
        "coulomb_friction_Nm", "mass_kg", "viscous_friction_N_s_per_m", "coulomb_friction_N"}) {
    scale(axis, key, by);
  }
  if (auto* friction = axis["friction"].as_table()) {
    scale(*friction, "breakaway_Nm", by);
    if (auto* position = (*friction)["position"].as_table()) {
      scale(*position, "friction_Nm", by);
    }
  }
}

// The model as a known force has corrected it, kept beside the diagnosis that it was used in.
PlantModel corrected(const PlantModel& plant, const std::string& axis,
                     const active::Correction& known, const std::filesystem::path& folder) {
  using Of = active::Correction::Of;
  if (known.of == Of::kNothing) {
    return plant;
  }
  toml::table table = plant.plant;
  toml::table& stated = *table["axis"][axis].as_table();
  if (known.of == Of::kAmplifier) {
    scale(stated, "amplifier_gain_A_per_V", 1 / known.ratio);
    scale(stated, "force_gain_N_per_V", 1 / known.ratio);
  } else {
    scale_everything_else(stated, known.ratio);
  }
  std::filesystem::create_directories(folder);
  const auto path = folder / "corrected_plant.toml";
  std::ofstream file(path);
  file << toml::toml_formatter{table, toml::toml_formatter::default_flags &
                                          ~toml::format_flags::allow_literal_strings}
       << '\n';
  file.close();
  return load_plant_model(path, axis);
}

diagnose::Interval fit_bias_corrected(const DiagnoseOptions& options, const PlantModel& plant,
                                      const std::string& folder, const active::Push& push) {
  logs::Findings findings;
  diagnose::NominalModel model = plant.model;
  const diagnose::Run run = read_log(folder, options, model, findings);
  return diagnose::force_ratio(model, run,
                               {.force_N = push.force_N, .from_s = push.from_s, .to_s = push.to_s});
}

harness::RunResult run_quietly(const DiagnoseOptions& options,
                               const harness::ExperimentFixture& fixture,
                               const std::filesystem::path& out, std::uint64_t seed) {
  harness::ExperimentOptions how;
  how.out = out.string();
  how.seed = seed;
  how.json = true;  // its table would stand between the lines of the answer
  how.quiet = options.quiet;
  return harness::run_with_options(fixture, how);
}

active::Hands hands_of(const DiagnoseOptions& options, const PlantModel& plant) {
  active::Hands hands;
  hands.diagnose = [&](const active::Logs& data, const active::Logs& holdout,
                       const std::filesystem::path& folder, const active::Correction& known) {
    DiagnoseOptions round = options;
    round.data = data;
    round.holdout = holdout;
    round.out = folder.string();
    const PlantModel model = corrected(plant, options.axis, known, folder);
    diagnose::Diagnosis d = diagnose_logs(round, model);
    write_diagnosis(round, model, d);
    return d;
  };
  hands.run = [&](const harness::ExperimentFixture& fixture, const std::filesystem::path& out,
                  std::uint64_t seed) { return run_quietly(options, fixture, out, seed); };
  hands.weigh_force = [&](const std::string& folder, const active::Push& push) {
    return fit_bias_corrected(options, plant, folder, push);
  };
  hands.tell = [&](const std::string& line) {
    if (!options.quiet) {
      std::fprintf(stderr, "%s\n", line.c_str());
    }
  };
  return hands;
}

int exit_code_of(active::Outcome::End end) {
  using End = active::Outcome::End;
  return end == End::kRunFailed ? harness::kExitFail
         : end == End::kStopped ? harness::kExitRuntime
                                : harness::kExitPass;
}

}  // namespace

void add_active_options(CLI::App& verb, ActiveOptions& options) {
  auto* active = verb.add_flag("--active", options.wanted,
                               "run the experiments that separate what the logs leave open");
  verb.add_option("--rig", options.rig,
                  "with --active: the machine; default: the copy in the first run folder")
      ->check(CLI::ExistingFile)
      ->needs(active);
  verb.add_option("--rounds", options.most_rounds, "with --active: experiments at most")
      ->check(CLI::Range(1, 20))
      ->needs(active);
}

int diagnose_and_run(const DiagnoseOptions& options, const ActiveOptions& active) {
  const PlantModel plant = load_plant_model(model_of(options), options.axis);
  const active::Request request{.data = options.data,
                                .holdout = options.holdout,
                                .rig = active.rig,
                                .out = options.out,
                                .axis = options.axis,
                                .most_rounds = active.most_rounds};
  const active::Outcome outcome = active::diagnose_actively(request, hands_of(options, plant));
  std::fputs((options.json ? active::json_of(outcome) : active::told(request, outcome)).c_str(),
             stdout);
  return exit_code_of(outcome.end);
}

}  // namespace towbench::study
