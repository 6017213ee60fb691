// A campaign: faults x phases of motion x carriers x seeds x drawn machines on a set of motions, as
// its fixture says.
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include "harness/campaign/candidate_controller.h"
#include "harness/experiment/experiment_fixture.h"
#include "harness/fault_cases/fault_case.h"
#include "harness/fault_cases/motion_phases.h"

namespace towbench::harness {

// One [[inject]] of the fixture: every kind at every place, at every moment named.
struct CampaignEntry {
  std::vector<std::string> parts;
  std::vector<std::string> kinds;
  std::vector<std::string> motions;   // names; empty: all
  std::vector<std::string> phases;    // a random moment of each that the motion has
  std::string event;                  // instead of phases
  std::string words;                  // what is added: duration, parameters
  std::vector<std::string> also;      // further faults of the same case, each complete
  std::vector<std::string> carriers;  // empty: as the campaign
  std::uint64_t seeds = 0;            // 0: as the campaign
};

// A motion on which faults are tried, and its reference run, of BBMC or of the candidate
// controller. What is typed to BBMC waits for no answer; an image's script waits for the image's
// own words.
struct CampaignMotion {
  ExperimentFixture plain;
  std::unique_ptr<CaseRecord> reference{};
  std::shared_ptr<const ReferenceRun> candidate_reference{};

  [[nodiscard]] const CaseRecord& record() const noexcept {
    return candidate_reference ? candidate_reference->record : *reference;
  }
};
[[nodiscard]] CampaignMotion load_motion(const std::filesystem::path& path,
                                         const CandidateController& controller);
void run_reference(CampaignMotion& motion, const CandidateController& controller);

class DrawnMachines;

struct Campaign {
  Campaign();
  Campaign(Campaign&&) noexcept;
  Campaign& operator=(Campaign&&) noexcept;
  ~Campaign();

  std::string name;
  std::string title;
  std::uint64_t seeds = 1;
  std::uint64_t machines = 0;  // drawn ones, besides the nominal one: every draw at every spread
  // They differ from it by up to so much, relative. With several, a draw is the same machine taken
  // further from the nominal one.
  std::vector<double> spreads{0.1};
  // The campaign that a controller program gets instead of this one, because its motions state
  // their reference. Empty: there is none.
  std::filesystem::path for_any_controller;
  bool without_fault = false;                   // every motion is judged by its budgets too
  bool without_fault_on_every_machine = false;  // the same on the drawn machines
  bool protocol_duties = false;                 // a program is tried on each (conformance.h) too
  CandidateController controller;
  std::filesystem::path file;
  std::vector<std::string> texts;  // of the file and of those that it builds on
  std::vector<CampaignEntry> entries;
  std::vector<CampaignMotion> motions;   // load_campaign(): reference runs have been run
  std::vector<std::string> carriers;     // empty: in one process
  std::vector<std::string> refused;      // "part kind over carrier: why"
  std::unique_ptr<DrawnMachines> drawn;  // once drawn (drawn_machines.h)
  // Of everything that decides a result: fixtures, seeds, machines and this program. Results that
  // bear another are of another campaign.
  std::string fingerprint;
  std::filesystem::path program = "/proc/self/exe";  // for the emulator's process

  [[nodiscard]] const CampaignMotion& motion(const std::string& name) const;
  // Of machine 1 .. machines; 0 for the nominal one.
  [[nodiscard]] double spread_of(std::size_t machine) const noexcept {
    return machine == 0 ? 0.0 : spreads[(machine - 1) % spreads.size()];
  }
  [[nodiscard]] std::size_t draw_of(std::size_t machine) const noexcept {
    return machine == 0 ? 0 : (machine - 1) / spreads.size() + 1;
  }
};

// One case, complete in words: `run MOTION --carrier CARRIER --fault "WORDS" ...` repeats it.
struct CampaignCase {
  std::string id;  // motion/part.kind/moment/seed, and the carrier unless there is none
  std::string motion;
  std::string part;
  std::string kind;
  std::string moment;                  // phase or event; "built" for what is so from the start
  std::vector<std::string> faults;     // in words; the first is the one that the case is about;
                                       // none: the motion itself, or the duty, is judged
  std::size_t machine = 0;             // 0: nominal
  std::string carrier = "in-process";  // as `run --carrier` takes it
  // Of the same phase, tried in turn while the fault takes no effect at the moment before: an edge
  // cannot go missing where there is none.
  std::vector<double> further_moments_s{};

  // One of the protocol's, named by the kind: there is no motion, and no run folder.
  [[nodiscard]] bool is_duty() const noexcept { return part == "protocol"; }
};

// The files alone: nothing has run. Throws FixtureError.
[[nodiscard]] Campaign read_campaign(const std::filesystem::path& path,
                                     const CandidateController& controller = {});
// Throws FixtureError. `seeds` instead of every number of seeds in the fixture when it is not 0.
[[nodiscard]] Campaign load_campaign(const std::filesystem::path& path, std::uint64_t seeds,
                                     const CandidateController& controller = {});
// The same list in the same order, on every machine.
[[nodiscard]] std::vector<CampaignCase> cases_of(const Campaign& campaign);
// The entries that ask for something that none of their motions has, in words. What was asked for
// and not tried is no pass.
[[nodiscard]] std::vector<std::string> entries_without_cases(const Campaign& campaign);
[[nodiscard]] FaultPlan plan_of(const CampaignCase& one);
// One line of JSON without its end.
[[nodiscard]] std::string run_campaign_case(const Campaign& campaign, const CampaignCase& one);
// What stands for a case whose process died in it.
[[nodiscard]] std::string crashed_case(const Campaign& campaign, const CampaignCase& one,
                                       const std::string& how);

}  // namespace towbench::harness
