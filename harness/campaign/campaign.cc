#include "harness/campaign/campaign.h"

#include <algorithm>

#include <fmt/format.h>

#include "core/check.h"
#include "core/random.h"
#include "harness/faults/case_run.h"
#include "harness/faults/fault_text.h"
#include "harness/fixtures/canonical_hash.h"

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
  reader.value("seeds", entry.seeds, core::between(0, 1e6), "instead of the campaign's");
  reader.require("parts");
  reader.require("kinds");
  reader.finish();
  return entry;
}

// Tried once, so that a slip is told before the first case.
void check_entry(const CampaignEntry& entry) {
  for (const auto& part : entry.parts) {
    for (const auto& kind : entry.kinds) {
      const auto place = place_named(part);
      const auto* row = place ? find_fault(place->part, kind) : nullptr;
      const bool built = row != nullptr && row->start == FaultStart::kWholeRun;
      (void)parse_fault(fmt::format("{} {} {} {}", part, kind, built ? "" : "at=1s", entry.words));
    }
  }
}

std::uint64_t hash_of(const std::string& text) {
  CanonicalHash hash;
  hash.add(text);
  return hash.value();
}

class CaseList {
 public:
  explicit CaseList(const Campaign& campaign) : campaign_(campaign) {}

  std::vector<CampaignCase> build() {
    for (const auto& entry : campaign_.entries) {
      for (const auto& motion : campaign_.motions) {
        const auto& name = motion.plain.experiment.name;
        const bool wanted =
            entry.motions.empty() ||
            std::find(entry.motions.begin(), entry.motions.end(), name) != entry.motions.end();
        if (wanted) {
          cross(entry, motion);
        }
      }
    }
    return std::move(cases_);
  }

 private:
  void cross(const CampaignEntry& entry, const CampaignMotion& motion) {
    for (const auto& part : entry.parts) {
      for (const auto& kind : entry.kinds) {
        const auto place = place_named(part);
        const bool built = find_fault(place->part, kind)->start == FaultStart::kWholeRun;
        if (built) {
          add(entry, motion, part, kind, "built", "", 1);
        } else if (!entry.event.empty()) {
          add_event(entry, motion, part, kind);
        } else {
          add_phases(entry, motion, part, kind, *place);
        }
      }
    }
  }

  [[nodiscard]] std::uint64_t seeds(const CampaignEntry& entry) const {
    return entry.seeds == 0 ? campaign_.seeds : entry.seeds;
  }

  void add_event(const CampaignEntry& entry, const CampaignMotion& motion, const std::string& part,
                 const std::string& kind) {
    for (std::uint64_t seed = 1; seed <= seeds(entry); ++seed) {
      add(entry, motion, part, kind, entry.event, "event=" + entry.event, seed);
    }
  }

  void add_phases(const CampaignEntry& entry, const CampaignMotion& motion, const std::string& part,
                  const std::string& kind, const FaultPlace& place) {
    Fault fault;
    fault.place = place;
    const auto spans = phases_of(*motion.twin, trigger_axis(fault, *motion.twin));
    // The motion itself; what is tried afterwards belongs to the script.
    const auto end_ns = onset_of({.kind = FaultTrigger::Kind::kEvent, .name = "motion_end"},
                                 fault.place.axis, *motion.twin);
    for (const auto& phase : entry.phases) {
      std::vector<PhaseSpan> fitting;
      std::copy_if(spans.begin(), spans.end(), std::back_inserter(fitting),
                   [&](const PhaseSpan& span) {
                     return span.phase == phase && (!end_ns || span.from_ns < *end_ns);
                   });
      if (fitting.empty()) {
        continue;  // this motion has no such phase
      }
      for (std::uint64_t seed = 1; seed <= seeds(entry); ++seed) {
        core::Random random(hash_of(
            fmt::format("{}/{}/{}/{}/{}", motion.plain.experiment.name, part, kind, phase, seed)));
        const auto& span = fitting[random.bits() % fitting.size()];
        const auto length_ns = static_cast<double>(span.to_ns - span.from_ns);
        const auto at_ns =
            span.from_ns + static_cast<core::Nanoseconds>(random.uniform() * length_ns);
        add(entry, motion, part, kind, phase, fmt::format("at_s={}", core::seconds(at_ns)), seed);
      }
    }
  }

  void add(const CampaignEntry& entry, const CampaignMotion& motion, const std::string& part,
           const std::string& kind, const std::string& moment, const std::string& trigger,
           std::uint64_t seed) {
    const auto& name = motion.plain.experiment.name;
    auto words = fmt::format("{} {}", part, kind);
    for (const auto& more : {trigger, entry.words}) {
      words += more.empty() ? "" : ' ' + more;
    }
    words += fmt::format(" seed={}", seed);
    auto id = fmt::format("{}/{}.{}/{}/{}", name, part, kind, moment, seed);
    if (!entry.words.empty()) {
      id += '/' + entry.words;
      std::replace(id.begin(), id.end(), ' ', ',');
    }
    cases_.push_back({std::move(id), name, part, kind, moment, std::move(words)});
  }

  const Campaign& campaign_;
  std::vector<CampaignCase> cases_;
};

}  // namespace

const CampaignMotion& Campaign::motion(const std::string& wanted) const {
  const auto found = std::find_if(motions.begin(), motions.end(), [&](const CampaignMotion& each) {
    return each.plain.experiment.name == wanted;
  });
  core::check(found != motions.end());
  return *found;
}

Campaign load_campaign(const std::filesystem::path& path, std::uint64_t seeds) {
  const auto file = FixtureFile::load(path);
  TableReader reader(file, file.table());
  Campaign campaign;
  std::vector<std::string> motions;
  reader.text("name", campaign.name, "short name");
  reader.text("title", campaign.title, "one line for a person");
  reader.strings("motions", motions, "experiments on which faults are tried");
  reader.value("seeds", campaign.seeds, core::between(1, 1e6), "cases of each combination");
  for (auto& table : reader.tables("inject")) {
    campaign.entries.push_back(read_entry(table));
    check_entry(campaign.entries.back());
  }
  for (const char* key : {"name", "motions", "inject"}) {
    reader.require(key);
  }
  reader.finish();
  campaign.seeds = seeds == 0 ? campaign.seeds : seeds;
  for (const auto& motion : motions) {
    auto plain =
        without_expectations(load_experiment(file.resolve(motion, reader.place_of("motions"))));
    auto twin = run_twin(plain, plain.experiment.seed);
    campaign.motions.push_back({std::move(plain), std::move(twin)});
  }
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
  for (const auto& row : fault_catalogue()) {
    if (!row.refused.empty()) {
      campaign.incapable.push_back(
          fmt::format("{} {}: {}", name_of(row.part), row.name, row.refused));
    }
  }
  return campaign;
}

std::vector<CampaignCase> cases_of(const Campaign& campaign) {
  return CaseList(campaign).build();
}

}  // namespace towbench::harness
