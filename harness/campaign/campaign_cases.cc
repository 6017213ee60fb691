// The cases of a campaign: every combination that its entries name, each with a name of its own.
#include <algorithm>
#include <iterator>
#include <map>

#include <fmt/format.h>

#include "core/random.h"
#include "harness/campaign/campaign.h"
#include "harness/external/conformance.h"
#include "harness/fixtures/canonical_hash.h"

namespace towbench::harness {
namespace {

constexpr const char* kNoCarrier = "in-process";
constexpr std::size_t kFurtherMoments = 7;

std::uint64_t hash_of(const std::string& text) {
  CanonicalHash hash;
  hash.add(text);
  return hash.value();
}

std::string name_of_entry(const CampaignEntry& entry) {
  return fmt::format("[[inject]] {} {} phases \"{}\"", fmt::join(entry.parts, ","),
                     fmt::join(entry.kinds, ","), fmt::join(entry.phases, ","));
}

std::string name_in_phase(const std::string& part, const std::string& kind,
                          const std::string& phase) {
  return fmt::format("[[inject]] {} {} phase \"{}\"", part, kind, phase);
}

class CaseList {
 public:
  explicit CaseList(const Campaign& campaign) : campaign_(campaign) {}

  std::vector<CampaignCase> build() {
    if (campaign_.without_fault || campaign_.without_fault_on_every_machine) {
      for (const auto& motion : campaign_.motions) {
        add_without_fault(motion.plain.experiment.name);
      }
    }
    if (campaign_.protocol_duties && campaign_.controller.external) {
      for (const auto& duty : conformance_duties(campaign_.motions.front().plain.rig.parameters)) {
        cases_.push_back(
            {"protocol/" + duty, "protocol", "protocol", duty, "none", {}, 0, kNoCarrier});
      }
    }
    for (const auto& entry : campaign_.entries) {
      const auto before = cases_.size();
      in_phase_.clear();
      for (const auto& motion : campaign_.motions) {
        const auto& name = motion.plain.experiment.name;
        const bool wanted =
            entry.motions.empty() ||
            std::find(entry.motions.begin(), entry.motions.end(), name) != entry.motions.end();
        if (wanted) {
          cross(entry, motion);
        }
      }
      if (cases_.size() == before) {
        without_.push_back(name_of_entry(entry));
        continue;
      }
      for (const auto& [name, found] : in_phase_) {
        if (!found) {
          without_.push_back(name);
        }
      }
    }
    return std::move(cases_);
  }

  // What was asked for and gave no case on any motion, in words.
  [[nodiscard]] const std::vector<std::string>& without() const noexcept { return without_; }

 private:
  void cross(const CampaignEntry& entry, const CampaignMotion& motion) {
    for (const auto& part : entry.parts) {
      for (const auto& kind : entry.kinds) {
        const auto place = place_named(part);
        const bool built = find_fault(place->part, kind)->start == FaultStart::kWholeRun;
        if (built) {
          add_built(entry, motion, part, kind);
        } else if (!entry.event.empty()) {
          add_event(entry, motion, part, kind);
        } else {
          add_phases(entry, motion, part, kind, *place);
        }
      }
    }
  }

  [[nodiscard]] std::vector<std::string> carriers_of(const CampaignEntry& entry) const {
    const auto& named = entry.carriers.empty() ? campaign_.carriers : entry.carriers;
    return named.empty() ? std::vector<std::string>{kNoCarrier} : named;
  }

  [[nodiscard]] std::uint64_t seeds(const CampaignEntry& entry) const {
    return entry.seeds == 0 ? campaign_.seeds : entry.seeds;
  }

  void add_without_fault(const std::string& motion) {
    const auto last = campaign_.without_fault_on_every_machine ? campaign_.machines : 0;
    for (std::size_t machine = 0; machine <= last; ++machine) {
      CampaignCase one;
      one.id = motion + "/no.fault";
      if (machine > 0) {
        one.id += fmt::format("/machine-{}", machine);
      }
      one.motion = motion;
      one.part = "no";
      one.kind = "fault";
      one.moment = "none";
      one.machine = machine;
      cases_.push_back(one);
    }
  }

  // What is so from the start has no moment to draw: one case a machine.
  void add_built(const CampaignEntry& entry, const CampaignMotion& motion, const std::string& part,
                 const std::string& kind) {
    for (std::uint64_t seed = 1; seed <= std::min(seeds(entry), campaign_.machines + 1); ++seed) {
      add(entry, motion, part, kind, "built", "", seed);
    }
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
    const auto& reference = motion.record();
    const auto spans = phases_of(reference, trigger_axis(fault, reference));
    // The motion itself; what is tried afterwards belongs to the script.
    const auto end_ns = onset_of({.kind = FaultTrigger::Kind::kEvent, .name = "motion_end"},
                                 fault.place.axis, reference);
    for (const auto& phase : entry.phases) {
      std::vector<PhaseSpan> fitting;
      std::copy_if(spans.begin(), spans.end(), std::back_inserter(fitting),
                   [&](const PhaseSpan& span) {
                     return span.phase == phase && (!end_ns || span.from_ns < *end_ns);
                   });
      auto& found = in_phase_[name_in_phase(part, kind, phase)];
      if (fitting.empty()) {
        continue;  // this motion has no such phase
      }
      found = true;
      for (std::uint64_t seed = 1; seed <= seeds(entry); ++seed) {
        core::Random random(hash_of(
            fmt::format("{}/{}/{}/{}/{}", motion.plain.experiment.name, part, kind, phase, seed)));
        const double at_s = moment_in(fitting, random);
        std::vector<double> further_s(kFurtherMoments);
        std::generate(further_s.begin(), further_s.end(),
                      [&] { return moment_in(fitting, random); });
        add(entry, motion, part, kind, phase, fmt::format("at_s={}", at_s), seed, further_s);
      }
    }
  }

  void add(const CampaignEntry& entry, const CampaignMotion& motion, const std::string& part,
           const std::string& kind, const std::string& moment, const std::string& trigger,
           std::uint64_t seed, const std::vector<double>& further_moments_s = {}) {
    const auto& name = motion.plain.experiment.name;
    auto words = fmt::format("{} {}", part, kind);
    for (const auto& more : {trigger, entry.words}) {
      words += more.empty() ? "" : ' ' + more;
    }
    words += fmt::format(" seed={}", seed);
    auto id = fmt::format("{}/{}.{}/{}/{}", name, part, kind, moment, seed);
    if (!entry.words.empty()) {
      id += '/' + entry.words;
    }
    std::vector<std::string> faults{std::move(words)};
    for (const auto& more : entry.also) {
      id += "/and " + more;
      faults.push_back(more);
    }
    const auto machine = static_cast<std::size_t>((seed - 1) % (campaign_.machines + 1));
    for (const auto& carrier : carriers_of(entry)) {
      const auto over = carrier == kNoCarrier ? std::string() : "/over " + carrier;
      cases_.push_back(
          {id + over, name, part, kind, moment, faults, machine, carrier, further_moments_s});
      auto& named = cases_.back().id;
      std::replace(named.begin(), named.end(), ' ', ',');
    }
  }

  const Campaign& campaign_;
  std::vector<CampaignCase> cases_;
  std::vector<std::string> without_;
  std::map<std::string, bool> in_phase_;  // of one entry: whether any motion has such a phase
};

}  // namespace

std::vector<CampaignCase> cases_of(const Campaign& campaign) {
  return CaseList(campaign).build();
}

std::vector<std::string> entries_without_cases(const Campaign& campaign) {
  CaseList list(campaign);
  (void)list.build();
  return list.without();
}

}  // namespace towbench::harness
