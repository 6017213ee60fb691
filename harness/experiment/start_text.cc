#include "harness/experiment/start_text.h"

#include <fmt/format.h>

#include "harness/files/turning_key.h"
#include "harness/fixtures/canonical_hash.h"
#include "harness/fixtures/toml_number.h"

namespace towbench::harness {
namespace {

std::string start_key(core::Axis axis, bool turns) {
  const auto in_m = fmt::format("{}_m", core::name_of(axis));
  return turns ? turning_key(in_m) : in_m;
}

}  // namespace

void read_start(TableReader& experiment, RigFixture& rig) {
  auto start = experiment.subtable("start");
  if (!start) {
    return;
  }
  for (const auto which : core::kAllAxes) {
    auto& axis = rig.parameters.axes[which];
    for (const bool turns : {false, true}) {
      const auto given = start_key(which, turns);
      if (start->has(given) && !axis.exists) {
        throw FixtureError(start->place_of(given), "the place of an axis that the rig lacks",
                           "places of the rig's axes");
      }
      if (start->has(given) && turns != axis.load_turns) {
        throw FixtureError(start->place_of(given), "a unit that does not fit the axis",
                           start_key(which, axis.load_turns));
      }
    }
    start->value(start_key(which, axis.load_turns), axis.start_m,
                 core::between(axis.plant.hard_ends.min_m, axis.plant.hard_ends.max_m),
                 "carriage position at time 0, between the hard ends");
  }
  start->finish();
  rig.hash = canonical_hash(rig.parameters);
  rig.parameters.fixture_hash = rig.hash;
}

std::string start_toml(const emulator::RigParameters& rig) {
  std::string text = "\n[start]\n";
  for (const auto which : core::kAllAxes) {
    const auto& axis = rig.axes[which];
    if (axis.exists) {
      text +=
          fmt::format("{} = {}\n", start_key(which, axis.load_turns), toml_number(axis.start_m));
    }
  }
  return text;
}

}  // namespace towbench::harness
