#include "harness/campaign/campaign.h"

#include <algorithm>
#include <fstream>
#include <sstream>

#include <fmt/format.h>

#include "core/check.h"
#include "harness/campaign/drawn_machines.h"
#include "harness/campaign/own_motions.h"
#include "harness/fault_cases/case_run.h"
#include "harness/fault_cases/machine_faults.h"
#include "harness/fault_plan/fault_text.h"
#include "harness/fixtures/canonical_hash.h"
#include "harness/run/run_carrier.h"

namespace towbench::harness {
namespace {

CampaignEntry read_entry(TableReader& reader) {
  CampaignEntry entry;
  reader.strings("parts", entry.parts, "places of the fault");
  reader.strings("kinds", entry.kinds, "kinds of fault");
  reader.strings("motions", entry.motions, "names of the motions; all when absent");
  reader.strings("phases", entry.phases, "phases of motion in which it begins");
  reader.text("event", entry.event, "or the event with which it begins");
  reader.text("words", entry.words, "more words of the fault");
  reader.strings("also", entry.also, "further faults at the same time, in words");
  reader.value("seeds", entry.seeds, core::between(0, 1e6), "instead of the campaign's");
  reader.strings("carriers", entry.carriers, "instead of the campaign's");
  reader.require("parts");
  reader.require("kinds");
  reader.finish();
  return entry;
}

CarrierKind kind_of_carrier(const std::string& carrier) {
  RunOptions options;
  choose_carrier(carrier, options);
  return kind_of(options);
}

// Tried once, so that a slip is told before the first case, with its place in the file.
void check_words(const std::string& words, const FixtureError::Place& place) {
  try {
    (void)parse_fault(words);
  } catch (const FixtureError& error) {
    throw FixtureError(place, '"' + words + '"', error.what());
  }
}

void check_entry(const CampaignEntry& entry, const TableReader& reader) {
  for (const auto& words : entry.also) {
    check_words(words, reader.place_of("also"));
  }
  for (const auto& part : entry.parts) {
    for (const auto& kind : entry.kinds) {
      const auto place = place_named(part);
      const auto* row = place ? find_fault(place->part, kind) : nullptr;
      const bool built = row != nullptr && row->start == FaultStart::kWholeRun;
      check_words(fmt::format("{} {} {} {}", part, kind, built ? "" : "at=1s", entry.words),
                  reader.place_of("kinds"));
    }
  }
}

// Every combination that the file names must be one that there is.
void check_carriers(const Campaign& campaign, const CampaignEntry& entry) {
  const auto& carriers = entry.carriers.empty() ? campaign.carriers : entry.carriers;
  for (const auto& carrier : carriers) {
    const auto kind = kind_of_carrier(carrier);
    for (const auto& part : entry.parts) {
      for (const auto& name : entry.kinds) {
        const auto why = why_not_over(kind, find_fault(place_named(part)->part, name)->kind);
        if (!why.empty()) {
          throw FixtureError({.file = campaign.file.string(), .key = "carriers"},
                             fmt::format("{} {} over {}", part, name, carrier), std::string(why));
        }
      }
    }
  }
}

void check_motions(const Campaign& campaign, const TableReader& reader) {
  for (const auto& entry : campaign.entries) {
    for (const auto& name : entry.motions) {
      const bool known = std::any_of(
          campaign.motions.begin(), campaign.motions.end(),
          [&](const CampaignMotion& motion) { return motion.plain.experiment.name == name; });
      if (!known) {
        throw FixtureError(reader.place_of("inject"), '"' + name + '"', "a motion of `motions`");
      }
    }
  }
}

// `spread` or `spreads`; a file says one of the two.
void read_spreads(TableReader& reader, Campaign& campaign) {
  constexpr std::size_t kMost = 16;
  const auto range = core::between(0.001, 0.3);
  core::BoundedVector<double, kMost> several;
  double one = 0;
  reader.value("spread", one, range, "largest relative difference of a drawn machine's parameters");
  reader.list("spreads", several, range, "the same, each draw at each of them");
  if (reader.has("spread") && reader.has("spreads")) {
    throw FixtureError(reader.place_of("spreads"), "spread and spreads together", "one of the two");
  }
  if (reader.has("spread")) {
    campaign.spreads = {one};
  } else if (!several.empty()) {
    campaign.spreads.assign(several.begin(), several.end());
  }
}

// What `base` names comes first; the file's own values stand instead of or behind it.
void read_file(const std::filesystem::path& path, Campaign& campaign) {
  const auto file = FixtureFile::load(path);
  campaign.texts.push_back(file.text());
  TableReader reader(file, file.table());
  std::string base;
  std::vector<std::string> motions;
  reader.text("base", base, "campaign whose motions and faults are tried first");
  if (!base.empty()) {
    read_file(file.resolve(base, reader.place_of("base")), campaign);
    take_own_motions(reader, campaign);
  }
  reader.text("name", campaign.name, "short name");
  reader.text("title", campaign.title, "one line for a person");
  reader.strings("motions", motions, "experiments on which faults are tried");
  reader.value("seeds", campaign.seeds, core::between(1, 1e6), "cases of each combination");
  if (!base.empty() && reader.has("seeds")) {
    for (auto& entry : campaign.entries) {
      entry.seeds = 0;
    }
  }
  reader.strings("carriers", campaign.carriers,
                 "in-process, local, serial-pty, or an address with both ends");
  reader.value("machines", campaign.machines, core::between(0, 1000),
               "machines drawn at random, besides the nominal one");
  read_spreads(reader, campaign);
  std::string other;
  reader.text("for_any_controller", other,
              "campaign that a program takes instead: its motions state their reference");
  if (!other.empty()) {
    campaign.for_any_controller = file.resolve(other, reader.place_of("for_any_controller"));
  }
  reader.value("without_fault", campaign.without_fault, core::Range{},
               "whether each motion is judged without a fault too, by its budgets");
  reader.value("without_fault_on_every_machine", campaign.without_fault_on_every_machine,
               core::Range{}, "the same on the drawn machines too");
  reader.value("protocol_duties", campaign.protocol_duties, core::Range{},
               "whether a program is tried on each duty of `towbench conform` too");
  for (auto& table : reader.tables("inject")) {
    campaign.entries.push_back(read_entry(table));
    check_entry(campaign.entries.back(), table);
  }
  reader.require("name");
  if (base.empty()) {
    reader.require("motions");
    if (!campaign.without_fault && !campaign.without_fault_on_every_machine) {
      reader.require("inject");
    }
  }
  reader.finish();
  for (const auto& motion : motions) {
    campaign.motions.push_back(
        load_motion(file.resolve(motion, reader.place_of("motions")), campaign.controller));
  }
  check_motions(campaign, reader);
}

// The bytes of what runs: results of another build are not this one's.
std::string this_program() {
  std::ifstream stream("/proc/self/exe", std::ios::binary);
  std::ostringstream bytes;
  bytes << stream.rdbuf();
  return bytes.str();
}

// What a controller cannot be given that is not BBMC.
void leave_out_beyond_reach(Campaign& campaign) {
  const bool is_image = !campaign.controller.external;
  const auto reach = is_image ? FaultReach::kMachine : FaultReach::kMachineAndLink;
  campaign.refused = {
      "host: such a controller's host is its own",
      is_image ? "link: an image on the virtual board has none"
               : "link peer_killed, peer_restart, bus_off, baud_mismatch: without a link there is "
                 "no run"};
  std::vector<CampaignEntry> kept;
  for (const auto& entry : campaign.entries) {
    for (const auto& part : entry.carriers.empty() ? entry.parts : std::vector<std::string>{}) {
      auto one = entry;
      one.parts = {part};
      std::erase_if(one.kinds, [&](const std::string& kind) {
        Fault fault;
        fault.place = *place_named(part);
        fault.kind = find_fault(fault.place.part, kind)->kind;
        return !is_within(fault, reach);
      });
      if (!one.kinds.empty()) {
        kept.push_back(std::move(one));
      }
    }
  }
  campaign.entries = std::move(kept);
  campaign.carriers.clear();
}

std::vector<std::string> refused_by_carriers() {
  std::vector<std::string> refused;
  for (const auto& row : fault_catalogue()) {
    for (const auto carrier :
         {CarrierKind::kInProcess, CarrierKind::kLocal, CarrierKind::kSerial, CarrierKind::kCan}) {
      if (const auto why = why_not_over(carrier, row.kind); !why.empty()) {
        refused.push_back(
            fmt::format("{} {} over {}: {}", name_of(row.part), row.name, name_of(carrier), why));
      }
    }
  }
  return refused;
}

std::string fingerprint_of(const Campaign& campaign) {
  CanonicalHash hash;
  for (const auto& text : campaign.texts) {
    hash.add(text);
  }
  for (const auto& motion : campaign.motions) {
    for (const auto& source : motion.plain.sources) {
      hash.add(source.text);
    }
  }
  hash.add(
      fmt::format("{}/{}/{}", campaign.seeds, campaign.machines, fmt::join(campaign.spreads, ",")));
  hash.add(this_program());
  add_identity(campaign.controller, hash);
  return hash_text(hash.value());
}

}  // namespace

CampaignMotion load_motion(const std::filesystem::path& path,
                           const CandidateController& controller) {
  auto motion = load_experiment(path);
  return {.plain = controller.is_bbmc() ? without_expectations(motion) : std::move(motion)};
}

void run_reference(CampaignMotion& motion, const CandidateController& controller) {
  if (!controller.is_bbmc()) {
    motion.candidate_reference = reference_run_of(controller, motion.plain);
    return;
  }
  if (!motion.plain.experiment.reference.empty()) {
    throw FixtureError({motion.plain.file.string()}, "[[reference]]",
                       "--controller process:COMMAND: BBMC has motions of its own");
  }
  motion.reference = run_reference(motion.plain, motion.plain.experiment.seed);
}

const CampaignMotion& Campaign::motion(const std::string& wanted) const {
  const auto found = std::find_if(motions.begin(), motions.end(), [&](const CampaignMotion& each) {
    return each.plain.experiment.name == wanted;
  });
  core::check(found != motions.end());
  return *found;
}

Campaign::Campaign() = default;
Campaign::Campaign(Campaign&&) noexcept = default;
Campaign& Campaign::operator=(Campaign&&) noexcept = default;
Campaign::~Campaign() = default;

Campaign read_campaign(const std::filesystem::path& path, const CandidateController& controller) {
  Campaign campaign;
  campaign.controller = controller;
  read_file(path, campaign);
  campaign.file = path;
  campaign.machines *= campaign.spreads.size();
  for (const auto& entry : campaign.entries) {
    check_carriers(campaign, entry);
  }
  return campaign;
}

Campaign load_campaign(const std::filesystem::path& path, std::uint64_t seeds,
                       const CandidateController& controller) {
  auto campaign = read_campaign(path, controller);
  if (controller.external && !campaign.for_any_controller.empty()) {
    campaign = read_campaign(std::filesystem::path(campaign.for_any_controller), controller);
  }
  if (seeds != 0) {
    campaign.seeds = seeds;
    for (auto& entry : campaign.entries) {
      entry.seeds = 0;
    }
  }
  if (controller.is_bbmc()) {
    campaign.refused = refused_by_carriers();
  } else {
    leave_out_beyond_reach(campaign);
  }
  for (auto& motion : campaign.motions) {
    run_reference(motion, controller);
  }
  campaign.fingerprint = fingerprint_of(campaign);
  return campaign;
}

}  // namespace towbench::harness
