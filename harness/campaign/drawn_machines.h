// Machines that differ from the fixtures' own by chance, as one built machine differs from the
// next: inertia, friction, motor and amplifier constants, transmission, delays of the end-stops.
// Where those sit is set at commissioning (the fault `displaced` moves them). The controller is
// told nothing.
//
// Each is written down as fixtures that `towbench run` takes, so that every case can be repeated
// and replayed: machine-K/<motion>.toml, its rig, and drawn.toml with the parameters that differ.
#pragma once

#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include "harness/campaign/campaign.h"

namespace towbench::harness {

class DrawnMachines {
 public:
  // Writes below `folder`. Throws FixtureError when a motion's file cannot be rewritten, and
  // filesystem_error.
  DrawnMachines(const Campaign& campaign, std::filesystem::path folder);

  // Of machine 1 .. machines. Runs the reference run when it is asked for; keeps those of one
  // machine.
  [[nodiscard]] const CampaignMotion& motion(std::size_t machine, const std::string& name);
  // The same without running anything.
  [[nodiscard]] ExperimentFixture plain(std::size_t machine, const std::string& name) const;
  // The file of a motion on a machine; the fixture's own for machine 0.
  [[nodiscard]] static std::filesystem::path file_of(const Campaign& campaign,
                                                     const std::filesystem::path& folder,
                                                     std::size_t machine, const std::string& name);

 private:
  std::filesystem::path folder_;
  CandidateController controller_;
  std::size_t machine_ = 0;
  std::vector<CampaignMotion> motions_;  // of that machine, as far as asked for
};

// Every case's motion, on the machine that it is about.
[[nodiscard]] const CampaignMotion& motion_of(const Campaign& campaign, const CampaignCase& one);

}  // namespace towbench::harness
