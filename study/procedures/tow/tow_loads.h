// One machine with different things below its platform: what a researcher changes between tows.
//
// A load is named by a rig file of fixtures/rigs (tow-dry, tow-cylinder, ...): its water, what the
// force sensor carries, and nothing else of that file. The machine above it is always the same one.
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>

#include "study/procedures/machine.h"

namespace towbench::study::procedures {

struct Load {
  std::string rig = "tow-dry";
  std::optional<double> yaw_deg{};  // the object is turned to this
  bool fin_works = true;            // false: the object's fin, if it has one, rests
};

class TowLoads {
 public:
  // `rigs`: the folder of the rig files. The machine's own water is not looked at. `source`: where
  // the runs come from (machine.h).
  TowLoads(harness::RigFixture machine, harness::ControllerFixture controller, std::uint64_t seed,
           std::filesystem::path rigs, harness::LoopWatchers watchers = {},
           RunSource* source = nullptr);

  // Throws FixtureError.
  [[nodiscard]] Machine with(const Load& load) const;
  // Whether any of it is in the water, as anybody can see. Throws FixtureError.
  [[nodiscard]] bool in_water(const Load& load) const;
  // All there is to know, for the judge: no procedure asks. Throws FixtureError.
  [[nodiscard]] emulator::RigParameters truth(const Load& load) const;

 private:
  [[nodiscard]] harness::RigFixture fixture(const Load& load) const;

  harness::RigFixture machine_;
  harness::ControllerFixture controller_;
  std::uint64_t seed_;
  std::filesystem::path rigs_;
  harness::LoopWatchers watchers_;
  RunSource* source_;
};

}  // namespace towbench::study::procedures
