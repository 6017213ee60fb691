#include "harness/commands/experiment_options.h"

#include <cstdio>

#include <CLI/CLI.hpp>
#include <fmt/format.h>

#include "core/time.h"
#include "harness/board_bench/firmware_run.h"
#include "harness/commands/carrier_option.h"
#include "harness/commands/encoder_option.h"
#include "harness/commands/exit_codes.h"
#include "harness/commands/option_checks.h"
#include "harness/commands/progress_line.h"
#include "harness/commands/stop_signal.h"
#include "harness/commands/tank_controller.h"
#include "harness/commands/wired_lines.h"
#include "harness/fixtures/fixture_error.h"
#include "harness/realtime/wall_clock_carrier.h"
#include "harness/report/report.h"
#include "protocol/carriers/line_address.h"

namespace towbench::harness {

void add_experiment_options(CLI::App& verb, ExperimentOptions& options) {
  verb.add_option("--out", options.out, "folder below which the run folder is made")
      ->check(folder_to_write())
      ->capture_default_str();
  verb.add_option("--seed", options.seed, "instead of the experiment's own seed")
      ->check(whole_number());
  verb.add_option("--carrier", options.carrier, kCarrierHelp);
  verb.add_option("--lines", options.lines, kLinesHelp);
  verb.add_option("--encoder-lines", options.encoder_lines, kEncoderLinesHelp);
  verb.add_option("--controller", options.controller, kControllerHelp);
  verb.add_option("--console", options.console,
                  "pty: the firmware's UART as a terminal for you, instead of the script")
      ->check(CLI::IsMember({"pty"}));
  verb.add_option("--clock", options.clock,
                  "lockstep: as fast as it goes, repeatable bit for bit; real: by the wall clock")
      ->check(CLI::IsMember({"lockstep", "real"}))
      ->capture_default_str();
  verb.add_flag("--json", options.json, "print the result as JSON instead of a table");
  verb.add_flag("-q,--quiet", options.quiet, "print failures and the report's path only");
  verb.add_flag("--no-image", options.no_image,
                "keep the SHA-256 of a firmware image in the run folder, not the image: no replay");
  verb.add_flag("--no-report", options.no_report, "write no report.html");
}

void choose_clock(const std::string& clock, RunOptions& options) {
  if (clock != "real") {
    return;
  }
  if (!options.firmware.empty()) {
    throw FixtureError({"command line", 0, "--clock"}, "real, with an image on the virtual board",
                       "lockstep, or --console pty: instructions are counted, not timed");
  }
  options.clock = RunClock::kReal;
  if (options.carrier == Carrier::kInProcess && !options.external) {
    options.carrier = Carrier::kLocal;
  }
}

void choose_lines(const std::string& text, RunOptions& options) {
  if (text.empty()) {
    return;
  }
  const auto comma = text.find(',');
  if (comma == std::string::npos || comma == 0 || comma + 1 == text.size()) {
    throw FixtureError({"command line", 0, "--lines"}, '"' + text + '"', "CONTROLLER,PLANT");
  }
  options.lines = {text.substr(0, comma), text.substr(comma + 1)};
  if (protocol::is_debounced(text) && options.clock != RunClock::kReal) {
    throw FixtureError({"command line", 0, "--lines"}, '"' + text + "\" in lockstep",
                       "a debounce, which lasts by the host's clock, with --clock real");
  }
  if (options.carrier == Carrier::kInProcess) {
    options.carrier = Carrier::kLocal;
  }
}

void choose_controller(const std::string& text, RunOptions& options) {
  if (text.empty()) {
    return;
  }
  constexpr std::string_view kScheme = "firmware:";
  constexpr std::string_view kProcess = "process:";
  constexpr std::string_view kExternal = "external:";
  const bool alone = options.carrier == Carrier::kInProcess;
  const bool is_process = text.starts_with(kProcess) && text.size() > kProcess.size();
  const bool is_external = text.starts_with(kExternal) && text.size() > kExternal.size();
  const bool is_firmware = text.starts_with(kScheme) && text.size() > kScheme.size();
  if (!(is_firmware || is_process || is_external) || !alone) {
    throw FixtureError({"command line", 0, "--controller"}, '"' + text + '"',
                       "firmware:IMAGE.elf, process:COMMAND or external:ADDRESS, without another "
                       "carrier");
  }
  if (is_process) {
    options.external = ExternalController{.command = text.substr(kProcess.size())};
    return;
  }
  if (is_external) {
    options.external = ExternalController{
        .address = carrier_address("--controller", text.substr(kExternal.size()))};
    return;
  }
  options.firmware = text.substr(kScheme.size());
  check_firmware(options.firmware);
}

namespace {

// By the wall clock a wire that cannot bear the worst case is refused before the run.
void check_load(const ExperimentFixture& fixture, const RunOptions& options) {
  if (options.clock != RunClock::kReal || options.carrier != Carrier::kWire) {
    return;
  }
  const auto exchange_ns =
      bbmc::exchange_period_ns(fixture.controller.configuration.control_period_ns());
  if (const auto bears = bears_the_wall_clock(options.wire->controller, exchange_ns); !bears) {
    throw FixtureError({"command line", 0, "--clock real"}, bears.error().message,
                       "a carrier that bears the worst case");
  }
}

// Another controller brings its lines itself: they are messages.
void refuse_lines_of_others(const ExperimentOptions& options) {
  if (!options.controller.empty() && !(options.lines.empty() && options.encoder_lines.empty())) {
    throw FixtureError({"command line", 0, options.lines.empty() ? "--encoder-lines" : "--lines"},
                       "beside --controller", "neither of them with another controller");
  }
}

// The record of a run is read back by its report: what does not agree is no result.
int tell_of_trouble(const ReportResult& written) {
  if (!written) {
    std::fprintf(stderr, "towbench: no report: %s\n", written.error().c_str());
    return kExitRuntime;
  }
  for (const auto& sentence : written->contradictions) {
    std::fprintf(stderr, "towbench: %s\n", sentence.c_str());
  }
  return written->contradictions.empty() ? kExitPass : kExitInvalid;
}

}  // namespace

RunResult run_with_options(const ExperimentFixture& fixture, const ExperimentOptions& options) {
  RunOptions run_options;
  run_options.out = options.out;
  run_options.seed = options.seed;
  choose_carrier(options.carrier, run_options);
  choose_controller(options.controller, run_options);
  choose_clock(options.clock, run_options);
  check_load(fixture, run_options);
  refuse_lines_of_others(options);
  choose_lines(options.lines, run_options);
  refuse_what_lines_cannot_carry("--lines", options.lines, fixture.rig.parameters);
  choose_encoder_lines(options.encoder_lines, run_options);
  check_encoder_lines(fixture, run_options);
  if (!options.console.empty() && run_options.firmware.empty()) {
    throw FixtureError({"command line", 0, "--console"}, options.console,
                       "with --controller firmware:IMAGE.elf");
  }
  run_options.keeps_image = !options.no_image;
  run_options.person_at_console = !options.console.empty();
  run_options.watchers.terminal = [](const std::string& path) {
    std::fprintf(stderr, "console: %s   (any terminal program; Ctrl-C here ends the run)\n",
                 path.c_str());
  };
  run_options.watchers.waiting = [](const std::string& address) {
    std::fprintf(stderr, "waiting for a controller at %s\n", address.c_str());
  };
  run_options.watchers.stop = &stop_requested();
  ProgressLine progress(!options.quiet && !options.json);
  run_options.watchers.progress = [&](core::Nanoseconds now_ns) {
    progress.show_sometimes([&] {
      const double simulated_s = core::seconds(now_ns);
      return fmt::format("{}: {:.1f} s of at most {:.1f} s simulated, {:.0f} x real time",
                         fixture.experiment.name, simulated_s, fixture.experiment.duration_limit_s,
                         simulated_s / progress.elapsed_s());
    });
  };
  if (!options.quiet && !options.json && !run_options.external) {
    tell_notes(fixture.rig, options.controller.empty());
  }
  auto result = run_experiment(fixture, run_options);
  if (!options.quiet && !options.json) {
    std::fputs(result.timing.c_str(), stdout);
  }
  if (!options.no_report) {
    result.exit_code = graver(result.exit_code, tell_of_trouble(write_report(result.folder)));
  }
  return result;
}

}  // namespace towbench::harness
