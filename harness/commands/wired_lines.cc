#include "harness/commands/wired_lines.h"

#include <fmt/format.h>

#include "harness/fixtures/fixture_error.h"

namespace towbench::harness {
namespace {

constexpr const char* kOnTheCable =
    "end-stops, kill switch and amplifiers: the cable has no more lines";

}  // namespace

void refuse_what_lines_cannot_carry(const std::string& option, const std::string& given,
                                    const emulator::RigParameters& rig) {
  const auto refuse = [&](std::string_view what, core::Axis axis, const char* allowed) {
    throw FixtureError(
        {"command line", 0, option},
        fmt::format("{}, and a machine with {} {}", given, what, core::name_of(axis)), allowed);
  };
  for (const auto which : core::kFurtherAxes) {
    if (!given.empty() && rig.axes[which].exists) {
      refuse("axis", which, "lines of axes y and x");
    }
  }
  for (const auto which : core::kPlanarAxes) {
    const auto& axis = rig.axes[which];
    const bool wires_switches = option == "--lines" && !given.empty() && axis.exists;
    if (wires_switches && axis.home.fitted) {
      refuse("a home switch of", which, kOnTheCable);
    }
    if (wires_switches && axis.brake.fitted) {
      refuse("a holding brake of", which, kOnTheCable);
    }
  }
}

}  // namespace towbench::harness
