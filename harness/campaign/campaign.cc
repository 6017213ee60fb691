#include "harness/campaign/campaign.h"

#include <algorithm>
#include <fstream>
#include <sstream>

#include <fmt/format.h>

#include "core/check.h"
#include "harness/campaign/drawn_machines.h"
#include "harness/fault_cases/case_run.h"
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

// What `base` names comes first; the file's own values stand instead of or behind it.
void read_campaign(const std::filesystem::path& path, Campaign& campaign, CanonicalHash& hash) {
  const auto file = FixtureFile::load(path);
  hash.add(file.text());
  TableReader reader(file, file.table());
  std::string base;
  std::vector<std::string> motions;
  reader.text("base", base, "campaign whose motions and faults are tried first");
  if (!base.empty()) {
    read_campaign(file.resolve(base, reader.place_of("base")), campaign, hash);
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
  reader.value("spread", campaign.spread, core::between(0.001, 0.3),
               "largest relative difference of a drawn machine's parameters");
  for (auto& table : reader.tables("inject")) {
    campaign.entries.push_back(read_entry(table));
    check_entry(campaign.entries.back(), table);
  }
  reader.require("name");
  if (base.empty()) {
    reader.require("motions");
    reader.require("inject");
  }
  reader.finish();
  for (const auto& motion : motions) {
    auto plain =
        without_expectations(load_experiment(file.resolve(motion, reader.place_of("motions"))));
    auto reference = run_reference(plain, plain.experiment.seed);
    campaign.motions.push_back({std::move(plain), std::move(reference)});
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

}  // namespace

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

Campaign load_campaign(const std::filesystem::path& path, std::uint64_t seeds) {
  Campaign campaign;
  CanonicalHash hash;
  read_campaign(path, campaign, hash);
  campaign.file = path;
  if (seeds != 0) {
    campaign.seeds = seeds;
    for (auto& entry : campaign.entries) {
      entry.seeds = 0;
    }
  }
  for (const auto& row : fault_catalogue()) {
    for (const auto carrier :
         {CarrierKind::kInProcess, CarrierKind::kLocal, CarrierKind::kSerial, CarrierKind::kCan}) {
      if (const auto why = why_not_over(carrier, row.kind); !why.empty()) {
        campaign.refused.push_back(
            fmt::format("{} {} over {}: {}", name_of(row.part), row.name, name_of(carrier), why));
      }
    }
  }
  for (const auto& entry : campaign.entries) {
    check_carriers(campaign, entry);
  }
  for (const auto& motion : campaign.motions) {
    for (const auto& source : motion.plain.sources) {
      hash.add(source.text);
    }
  }
  hash.add(fmt::format("{}/{}/{}", campaign.seeds, campaign.machines, campaign.spread));
  hash.add(this_program());
  campaign.fingerprint = hash_text(hash.value());
  return campaign;
}

}  // namespace towbench::harness
