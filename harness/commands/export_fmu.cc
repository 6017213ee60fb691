// towbench export-fmu: an axis of a rig as a Functional Mock-up Unit.
#include <algorithm>
#include <cstdio>
#include <memory>
#include <string>

#include <CLI/CLI.hpp>
#include <fmt/format.h>

#include "harness/checks/check.h"
#include "harness/commands/command.h"
#include "harness/fixtures/rig_fixture.h"
#include "harness/fmi/axis_export.h"

namespace towbench::harness {
namespace {

// The build lays it beside this program.
constexpr const char* kBinary = "towbench-axis-fmu.so";

struct ExportOptions {
  std::string rig;
  std::string axis;
  std::string out;
};

core::Axis axis_of(const ExportOptions& options, const emulator::RigParameters& rig) {
  const auto found =
      std::find_if(core::kAllAxes.begin(), core::kAllAxes.end(), [&](core::Axis axis) {
        return core::name_of(axis) == options.axis && rig.axes[axis].exists;
      });
  if (found == core::kAllAxes.end()) {
    throw FixtureError({"--axis"}, '"' + options.axis + '"', "an axis that the rig has");
  }
  return *found;
}

int execute_export(const ExportOptions& options) {
  SourceFiles sources;
  const auto rig = load_rig(options.rig, sources);
  const auto axis = axis_of(options, rig.parameters);
  if (rig.parameters.foreign_plant) {
    throw FixtureError({options.rig}, "[plant]", "a rig that the built-in equations move");
  }
  const auto name = fmt::format("{}-{}", rig.name.empty() ? "machine" : rig.name, options.axis);
  const auto file = options.out.empty() ? name + ".fmu" : options.out;
  const auto binary = std::filesystem::read_symlink("/proc/self/exe").parent_path() / kBinary;
  export_axis(file, name, rig.parameters, axis, binary);
  std::printf("%s\n", file.c_str());
  return kExitPass;
}

}  // namespace

void add_export_fmu(CLI::App& app, int& exit_code) {
  auto options = std::make_shared<ExportOptions>();
  auto* verb =
      app.add_subcommand("export-fmu", "an axis of a rig as an FMI 3.0 Co-Simulation unit");
  verb->add_option("rig", options->rig, "rig file")->required();
  verb->add_option("--axis", options->axis, "its name")->required();
  verb->add_option("--out", options->out, "the unit's file; NAME-AXIS.fmu unless given");
  verb->footer("Example: towbench export-fmu fixtures/rigs/macs-nominal.toml --axis y --out y.fmu");
  verb->callback([options, &exit_code] { exit_code = execute_export(*options); });
}

}  // namespace towbench::harness
