#include "harness/commands/falsify_worst.h"

#include <cstdio>

#include <fmt/format.h>

#include "harness/commands/command.h"
#include "harness/experiment/experiment_toml.h"
#include "harness/fault_cases/faulted_experiment.h"
#include "harness/record/line_writer.h"
#include "harness/report/report.h"
#include "harness/run/run_carrier.h"

namespace towbench::harness {
namespace {

// The experiment with its worst faults and what was asked, as `towbench run` takes it. Files of its
// own are written below `folder`.
ExperimentFixture worst_experiment(const ExperimentFixture& fixture, const Asked& asked,
                                   const ShrunkCase& worst, const std::filesystem::path& folder) {
  auto made = fixture;
  if (!worst.needed.setup.is_nominal()) {
    std::filesystem::create_directories(folder);
    made = in_setup(fixture, worst.needed.setup, folder);
  }
  auto& experiment = made.experiment;
  experiment.requirements.clear();
  if (asked.requirement) {
    experiment.requirements.push_back(*asked.requirement);
    experiment.requirements.front().under_faults = true;
  }
  experiment.budgets.clear();
  constexpr std::size_t kLongestName = 53;
  experiment.name = experiment.name.substr(0, kLongestName) + "-worst";
  experiment.title = "Worst case found of " + asked.name();
  experiment.description =
      fmt::format("Found by towbench falsify in {}: margin {:.6g}{}{}.", fixture.experiment.name,
                  *worst.outcome.margin, asked.unit().empty() ? "" : " ", asked.unit());
  made.sources.front().text = to_toml(made);
  add_faults(made, worst.needed.faults);
  return made;
}

// A machine of its own stands beside it as a rig file.
void keep_experiment(const std::filesystem::path& file, const ExperimentFixture& fixture,
                     const Setup& setup, const ExperimentFixture& made) {
  const auto near = [&](const std::filesystem::path& path) {
    return path.empty() ? std::string()
                        : std::filesystem::proximate(std::filesystem::absolute(path),
                                                     std::filesystem::absolute(file).parent_path())
                              .generic_string();
  };
  auto rig = near(made.rig_file);
  if (setup.machine) {
    rig = file.stem().string() + "-rig.toml";
    write_atomically(
        std::filesystem::absolute(file).parent_path() / rig,
        changed_machine(fixture.rig_file, fixture.rig.parameters, *setup.machine,
                        "found by a search", std::filesystem::absolute(file).parent_path()));
  }
  write_atomically(file, to_toml(made, rig, near(made.controller_file)));
}

}  // namespace

int report_worst(const FalsifyOptions& options, const ExperimentFixture& fixture,
                 const Asked& asked, const CandidateController& controller,
                 const ShrunkCase& worst) {
  const auto made =
      worst_experiment(fixture, asked, worst, std::filesystem::path(options.out) / "worst-setup");
  RunOptions run_options;
  run_options.out = options.out;
  choose_candidate(controller, run_options);
  const auto run = run_experiment(made, run_options);
  if (const auto page = write_report(run.folder); !page) {
    std::fprintf(stderr, "towbench: %s\n", page.error().c_str());
  }
  if (!options.keep.empty()) {
    keep_experiment(options.keep, fixture, worst.needed.setup, made);
    std::printf("kept as %s\n", options.keep.c_str());
  }
  std::printf("%s\n", (run.folder / "report.html").c_str());
  return worst.outcome.broken ? kExitFail : kExitPass;
}

}  // namespace towbench::harness
