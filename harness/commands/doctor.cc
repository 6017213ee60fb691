// towbench doctor: is this host fit for wires and for real time, and what would improve it.
#include <cstdio>
#include <memory>

#include <CLI/CLI.hpp>
#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "harness/checks/check.h"
#include "harness/commands/command.h"
#include "harness/commands/option_checks.h"
#include "harness/realtime/host_findings.h"
#include "harness/realtime/loop_comparison.h"
#include "harness/realtime/own_lateness.h"
#include "harness/realtime/realtime_budget.h"

namespace towbench::harness {
namespace {

struct DoctorOptions {
  double seconds = 10;
  unsigned compare_blocks = 0;
  bool json = false;
};

int execute_doctor(const DoctorOptions& options) {
  if (options.compare_blocks > 0) {
    constexpr core::Nanoseconds kBlock_ns = core::kNanosecondsPerSecond / 2;
    fmt::print("{}", compare_loops(options.compare_blocks, kBlock_ns).text());
    return kExitPass;
  }
  auto findings = host_findings();
  if (options.seconds > 0) {
    SourceFiles sources;
    const auto budget = load_realtime_budget(sources);
    findings.push_back(
        lateness_finding(measure_own_lateness(core::nanoseconds(options.seconds)), budget));
  }
  auto lines = nlohmann::json::array();
  for (const auto& finding : findings) {
    if (options.json) {
      lines.push_back({{"subject", finding.subject},
                       {"fit", name_of(finding.fit)},
                       {"found", finding.found},
                       {"remedy", finding.remedy}});
    } else {
      fmt::print("{:<8} {:<12} {}{}\n", name_of(finding.fit), finding.subject, finding.found,
                 finding.remedy.empty() ? "" : "; " + finding.remedy);
    }
  }
  if (options.json) {
    fmt::print("{}\n", lines.dump(2));
  }
  // What a host lacks is a finding, not a failure.
  return kExitPass;
}

}  // namespace

void add_doctor(CLI::App& app, int& exit_code) {
  auto options = std::make_shared<DoctorOptions>();
  auto* verb = app.add_subcommand("doctor", "what this host is fit for, and how to improve it");
  verb->add_option("--seconds", options->seconds, "how long to measure its lateness; 0: not at all")
      ->check(seconds_given())
      ->check(CLI::Range(0.0, 3600.0))
      ->capture_default_str();
  verb->add_option("--compare", options->compare_blocks,
                   "instead: so many blocks of our loop against a bare one, half a second each")
      ->check(whole_number());
  verb->add_flag("--json", options->json, "print the findings as JSON");
  verb->footer("Example: towbench doctor --seconds 3");
  verb->callback([options, &exit_code] { exit_code = execute_doctor(*options); });
}

}  // namespace towbench::harness
