// Plays a procedure's runs as ordinary experiments: each leaves a run folder that a report, a
// replay and `tow --data` read, and the estimator reads that folder and nothing else.
#pragma once

#include <filesystem>
#include <functional>
#include <string>
#include <vector>

#include "harness/run/experiment_run.h"
#include "study/procedures/run_source.h"
#include "study/runs/tow_list.h"

namespace towbench::study {

class KeptRuns final : public procedures::RunSource {
 public:
  // Runs one experiment below a folder, with a seed.
  using Play = std::function<harness::RunResult(
      const harness::ExperimentFixture&, const std::filesystem::path& below, std::uint64_t seed)>;

  // `id`: the procedure's; its run folders lie below `out`/`id` and are added to `made`, which
  // outlives this.
  KeptRuns(std::string id, std::filesystem::path out, Play play, std::vector<ListedTow>& made)
      : id_(std::move(id)), out_(std::move(out)), play_(std::move(play)), made_(made) {}

  [[nodiscard]] identify::Recording run(const procedures::PlannedRun& planned) override;

 private:
  std::string id_;
  std::filesystem::path out_;
  Play play_;
  std::vector<ListedTow>& made_;
};

// Writes rig.toml, the plant.toml that it names, and controller.toml.
void write_machine(const harness::RigFixture& rig, const harness::ControllerFixture& controller,
                   const std::filesystem::path& folder);

// The planned run as an experiment whose files lie in `folder`. Throws FixtureError when they do
// not read back as what was planned.
[[nodiscard]] harness::ExperimentFixture as_experiment(const procedures::PlannedRun& planned,
                                                       const std::string& id,
                                                       const std::filesystem::path& folder);

}  // namespace towbench::study
