#include "harness/campaign/own_motions.h"

#include <algorithm>
#include <iterator>
#include <map>

#include <fmt/format.h>

#include "harness/fault_plan/fault.h"
#include "harness/fault_plan/fault_text.h"

namespace towbench::harness {
namespace {

// By name of the base's motion, the name of the machine's own.
using Names = std::map<std::string, std::string>;

bool holds(const std::vector<std::string>& names, const std::string& name) {
  return std::find(names.begin(), names.end(), name) != names.end();
}

// any-end-z-max of any-end-y-max; empty: it is no motion of y.
std::string motion_of(core::Axis further, const std::string& base) {
  const auto place = (base + '-').find("-y-");
  auto name = place == std::string::npos ? std::string{} : base;
  if (!name.empty()) {
    name.replace(place + 1, 1, core::name_of(further));
  }
  return name;
}

// Of a base, and for the further axes of a machine of its own.
std::vector<std::string> replaceable_motions(const Campaign& campaign) {
  std::vector<std::string> names;
  for (const auto& motion : campaign.motions) {
    const auto& base = motion.plain.experiment.name;
    names.push_back(base);
    for (const auto further : core::kFurtherAxes) {
      if (auto name = motion_of(further, base); !name.empty()) {
        names.push_back(std::move(name));
      }
    }
  }
  return names;
}

Names load_own(TableReader& table, Campaign& campaign) {
  Names names;
  std::vector<CampaignMotion> own;
  std::map<std::string, std::string> loaded;  // by file
  for (const auto& base : replaceable_motions(campaign)) {
    std::string file;
    table.text(base, file, "motion of this machine in its place");
    if (file.empty()) {
      continue;
    }
    auto& name = loaded[file];
    if (name.empty()) {
      own.push_back(
          load_motion(table.file().resolve(file, table.place_of(base)), campaign.controller));
      name = own.back().plain.experiment.name;
    }
    names[base] = name;
  }
  table.finish();
  campaign.motions = std::move(own);
  return names;
}

bool has_axis(const Campaign& campaign, core::Axis axis) {
  return std::any_of(
      campaign.motions.begin(), campaign.motions.end(),
      [&](const CampaignMotion& motion) { return motion.plain.rig.parameters.axes[axis].exists; });
}

// Whether anything of it is left.
bool moved_to(const Names& names, const Campaign& campaign, CampaignEntry& entry) {
  std::erase_if(entry.parts, [&](const std::string& part) {
    const auto place = place_named(part);
    return is_of_an_axis(place->part) && !has_axis(campaign, place->axis);
  });
  std::vector<std::string> motions;
  for (const auto& base : entry.motions) {
    const auto found = names.find(base);
    if (found != names.end() && !holds(motions, found->second)) {
      motions.push_back(found->second);
    }
  }
  const bool was_bound = !entry.motions.empty();
  entry.motions = std::move(motions);
  return !entry.parts.empty() && !(was_bound && entry.motions.empty());
}

// What a base does to the first axis, done to a further axis: on that axis' own motions, and on
// those of all.
CampaignEntry done_to(core::Axis further, const CampaignEntry& entry) {
  CampaignEntry done = entry;
  done.parts.clear();
  for (const auto& part : entry.parts) {
    auto place = *place_named(part);
    if (is_of_an_axis(place.part) && place.axis == core::kFirstAxis) {
      place.axis = further;
      done.parts.push_back(name_of(place));
    }
  }
  for (auto& motion : done.motions) {
    if (auto own = motion_of(further, motion); !own.empty()) {
      motion = std::move(own);
    }
  }
  return done;
}

std::vector<CampaignEntry> of_further_axes(const TableReader& reader, const Names& names,
                                           const Campaign& campaign) {
  std::vector<CampaignEntry> all;
  for (const auto further : core::kFurtherAxes) {
    const auto before = all.size();
    for (const auto& entry : campaign.entries) {
      auto done = done_to(further, entry);
      if (!done.parts.empty() && moved_to(names, campaign, done)) {
        all.push_back(std::move(done));
      }
    }
    if (has_axis(campaign, further) && all.size() == before) {
      throw FixtureError(reader.place_of("instead"),
                         fmt::format("no motion of axis {}", core::name_of(further)),
                         fmt::format("a motion of y with {} for y in its name = \"FILE\"",
                                     core::name_of(further)));
    }
  }
  return all;
}

void take_instead(TableReader& reader, Campaign& campaign) {
  auto table = reader.subtable("instead");
  if (!table) {
    return;
  }
  const auto names = load_own(*table, campaign);
  if (names.empty()) {
    throw FixtureError(reader.place_of("instead"), "no motion", "MOTION_OF_THE_BASE = \"FILE\"");
  }
  auto further = of_further_axes(reader, names, campaign);
  std::vector<CampaignEntry> kept;
  for (auto& entry : campaign.entries) {
    if (moved_to(names, campaign, entry)) {
      kept.push_back(std::move(entry));
    }
  }
  std::move(further.begin(), further.end(), std::back_inserter(kept));
  campaign.entries = std::move(kept);
}

// Parameters of a fault on this machine; empty: the base's.
std::string size_of(TableReader& table, const std::string& part, const std::string& kind) {
  const auto key = part + '.' + kind;
  std::string words;
  table.text(key, words, "parameters of the fault on this machine");
  if (!words.empty()) {
    try {
      (void)parse_fault(part + ' ' + kind + " at=1s " + words);
    } catch (const FixtureError& error) {
      throw FixtureError(table.place_of(key), '"' + words + '"', error.what());
    }
  }
  return words;
}

// The entry, or one for each of its faults that has a size and one for what is left of each part.
std::vector<CampaignEntry> sized(TableReader& table, const CampaignEntry& entry) {
  std::vector<CampaignEntry> all;
  bool any = false;
  for (const auto& part : entry.parts) {
    CampaignEntry rest = entry;
    rest.parts = {part};
    for (const auto& kind : entry.kinds) {
      const auto words = size_of(table, part, kind);
      if (words.empty()) {
        continue;
      }
      any = true;
      CampaignEntry one = rest;
      one.kinds = {kind};
      one.words += (one.words.empty() ? "" : " ") + words;
      all.push_back(std::move(one));
      std::erase(rest.kinds, kind);
    }
    if (!rest.kinds.empty()) {
      all.push_back(std::move(rest));
    }
  }
  return any ? all : std::vector<CampaignEntry>{entry};
}

void take_sizes(TableReader& reader, Campaign& campaign) {
  auto table = reader.subtable("sizes");
  if (!table) {
    return;
  }
  std::vector<CampaignEntry> all;
  for (const auto& entry : campaign.entries) {
    for (auto& one : sized(*table, entry)) {
      all.push_back(std::move(one));
    }
  }
  table->finish();
  campaign.entries = std::move(all);
}

}  // namespace

void take_own_motions(TableReader& reader, Campaign& campaign) {
  take_instead(reader, campaign);
  take_sizes(reader, campaign);
}

}  // namespace towbench::harness
