#include "study/results/set_up_tracking.h"

#include <cmath>

#include <fmt/format.h>

#include "harness/fixtures/fixture_paths.h"
#include "study/procedures/identified_controller.h"
#include "study/results/thesis_tracking.h"

namespace towbench::study {
namespace {

TrapezoidRun profile_of(const harness::ControllerFixture& controller, PlaceKnown place) {
  const auto& y = controller.configuration.axes[core::Axis::kY];
  TrapezoidRun run{.place = place};
  if (y.chain.enabled) {
    run.smooth_s = 1.0 / y.braking.held_motor_chain_Hz;
  }
  return run;
}

SetUpTracking track(const harness::RigFixture& rig, harness::ControllerFixture controller,
                    const procedures::Machine& machine, const identify::Estimates& estimates) {
  const auto speeds = speeds_of(kTable7_6);
  SetUpTracking tracking{.controller = controller.name, .told = {}, .set_up = {}, .trouble = {}};
  tracking.told =
      track_speeds(rig, controller, speeds, profile_of(controller, PlaceKnown::kTold), {});
  controller.configuration =
      procedures::set_up_controller(controller.configuration, machine, estimates).configuration;
  if (const char* contradiction = bbmc::inconsistency(controller.configuration)) {
    tracking.trouble = contradiction;
    return tracking;
  }
  tracking.set_up =
      track_speeds(rig, controller, speeds, profile_of(controller, PlaceKnown::kHomed), {});
  return tracking;
}

std::string cells(const TrackedRun& run) {
  if (!run.trouble.empty()) {
    return fmt::format("{} | | |", run.trouble);
  }
  return fmt::format("{:.2f} | {:.1f} | {:.0f} |", 1e6 * run.mean_m, 1e6 * run.rms_m,
                     1e6 * run.carriage_peak_m);
}

}  // namespace

std::vector<SetUpTracking> track_set_up(const harness::RigFixture& rig,
                                        const procedures::Machine& machine,
                                        const identify::Estimates& estimates) {
  std::vector<SetUpTracking> all;
  for (const char* name : {"bbmc-tuned", "bbmc-best"}) {
    harness::SourceFiles sources;
    all.push_back(track(
        rig,
        harness::load_controller(
            harness::fixtures_directory() / "controllers" / (std::string(name) + ".toml"), sources),
        machine, estimates));
  }
  return all;
}

std::string set_up_section(const std::string& name, const std::vector<SetUpTracking>& all) {
  std::string text = fmt::format("## Machine {}\n", name);
  for (const auto& tracking : all) {
    text += fmt::format("\n### `{}`\n\n", tracking.controller);
    if (!tracking.trouble.empty()) {
      text += "Not set up: " + tracking.trouble + "\n";
      continue;
    }
    text +=
        "| mm/s | as the file is, told its place: mean | RMS | carriage peak | set up and homed: "
        "mean | RMS | carriage peak | place off |\n"
        "| ---: | ---: | ---: | ---: | ---: | ---: | ---: | ---: |\n";
    for (std::size_t k = 0; k < tracking.told.size() && k < tracking.set_up.size(); ++k) {
      const auto& told = tracking.told[k];
      const auto& set_up = tracking.set_up[k].run;
      const auto place = set_up.trouble.empty() ? fmt::format("{:.1f}", 1e6 * set_up.place_off_m)
                                                : std::string("-");
      text += fmt::format("| {:.0f} | {} {} {} |\n", 1e3 * told.speed_m_per_s, cells(told.run),
                          cells(set_up), place);
    }
  }
  return text;
}

}  // namespace towbench::study
