#include "tests/study/diagnose/hidden_rig.h"

#include <atomic>
#include <fstream>
#include <stdexcept>

#include <fmt/format.h>
#include <unistd.h>

#include "harness/experiment/experiment_toml.h"
#include "harness/run/experiment_run.h"

namespace towbench::tests {
namespace {

namespace fs = std::filesystem;

std::string from(const fs::path& folder, const fs::path& file) {
  return fs::relative(fs::absolute(file), folder).string();
}

}  // namespace

HiddenRig::HiddenRig(const fs::path& stated, const std::string& hidden) {
  static std::atomic<int> count{0};
  folder_ = fs::temp_directory_path() / fmt::format("hidden_rig_{}_{}", getpid(), count++);
  fs::create_directories(folder_);
  std::ofstream(file()) << fmt::format(
      "schema = 1\nname = \"hidden\"\nplants = [\"{}\"]\n\n[axis.y]\nstart_m = 0.449092\n{}\n\n"
      "[axis.x]\nstart_m = 0.336819\n",
      from(folder_, stated), hidden);
}

HiddenRig::~HiddenRig() {
  std::error_code ignored;
  fs::remove_all(folder_, ignored);
}

fs::path HiddenRig::log_of(const fs::path& experiment) const {
  harness::ExperimentFixture fixture = harness::load_experiment(experiment);
  const fs::path copy = folder_ / experiment.filename();
  std::ofstream(copy) << harness::to_toml(fixture, "rig.toml",
                                          from(folder_, fixture.controller_file));
  harness::RunOptions options;
  options.out = folder_ / "logs";
  const harness::RunResult run = harness::run_experiment(harness::load_experiment(copy), options);
  if (!run.complete) {
    throw std::runtime_error(run.reason);
  }
  return run.folder;
}

}  // namespace towbench::tests
