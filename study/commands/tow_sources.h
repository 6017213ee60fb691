// What `tow` is asked to do, and where its tows come from: run folders that it keeps, a record, or
// nowhere but memory.
#pragma once

#include <cstdint>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "harness/commands/experiment_options.h"
#include "study/procedures/run_source.h"
#include "study/runs/tow_list.h"

namespace towbench::study {

struct TowOptions {
  std::string rig;
  std::vector<std::string> only;
  std::string settings;
  std::string data;
  bool no_runs = false;
  std::uint64_t drawn = 0;  // machines of a set; 0: this rig alone
  std::uint64_t seeds = 40;
  std::size_t workers = 1;
  harness::ExperimentOptions run;  // of each tow, as `run` has them

  [[nodiscard]] bool names_another_controller() const {
    return run.controller.find(':') != std::string::npos;  // firmware:IMAGE.elf and the like
  }
};

class TowSources {
 public:
  // `options` outlives this. Throws FixtureError for a record that cannot be read.
  explicit TowSources(const TowOptions& options);

  [[nodiscard]] bool is_wanted(std::string_view id) const;
  // Of one experiment; null: in memory.
  [[nodiscard]] std::unique_ptr<procedures::RunSource> of(const std::string& id);
  // tows.toml, beside the run folders that were kept so far.
  void write_list() const;

 private:
  const TowOptions& options_;
  std::optional<TowList> list_;
  std::vector<ListedTow> tows_;
};

struct TowSetup {
  harness::RigFixture rig;
  harness::ControllerFixture controller;
  std::filesystem::path settings;  // folder of the experiments' own files
};

// Given on the command line, else beside the record, else of this repository. Throws FixtureError.
[[nodiscard]] TowSetup setup_of(const TowOptions& options);

// What a later `tow --data` reads beside the run folders. `settings` may be empty.
void keep_setup(const TowSetup& setup, const std::filesystem::path& settings,
                const std::filesystem::path& out);

// Throws FixtureError for options that contradict each other.
void refuse_together(const TowOptions& options);

}  // namespace towbench::study
