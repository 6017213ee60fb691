#include "harness/commands/experiment_options.h"

#include <cstdio>

#include "harness/commands/progress_line.h"
#include "harness/commands/stop_signal.h"
#include "harness/report/report.h"

namespace towbench::harness {

void add_experiment_options(CLI::App& verb, ExperimentOptions& options) {
  verb.add_option("--out", options.out, "folder below which the run folder is made")
      ->capture_default_str();
  verb.add_option("--seed", options.seed, "instead of the experiment's own seed");
  verb.add_option("--carrier", options.carrier,
                  "in-process, or local: the emulator in a process of its own, over a local socket")
      ->check(CLI::IsMember({"in-process", "local"}))
      ->capture_default_str();
  verb.add_flag("--json", options.json, "print the result as JSON instead of a table");
  verb.add_flag("-q,--quiet", options.quiet, "print failures and the report's path only");
  verb.add_flag("--no-report", options.no_report, "write no report.html");
}

RunResult run_with_options(const ExperimentFixture& fixture, const ExperimentOptions& options) {
  RunOptions run_options;
  run_options.out = options.out;
  run_options.seed = options.seed;
  run_options.carrier = options.carrier == "local" ? Carrier::kLocal : Carrier::kInProcess;
  run_options.watchers.stop = &stop_requested();
  ProgressLine progress(fixture.experiment.name, fixture.experiment.duration_limit_s,
                        !options.quiet && !options.json);
  run_options.watchers.progress = [&](core::Nanoseconds now_ns) { progress.show(now_ns); };
  auto result = run_experiment(fixture, run_options);
  if (!options.no_report) {
    if (const auto written = write_report(result.folder); !written) {
      std::fprintf(stderr, "towbench: no report: %s\n", written.error().c_str());
      result.exit_code = result.exit_code == kExitPass ? kExitRuntime : result.exit_code;
    }
  }
  return result;
}

}  // namespace towbench::harness
