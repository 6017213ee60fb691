#include "harness/experiment/reference_text.h"

#include <algorithm>
#include <array>
#include <cmath>

#include <fmt/format.h>

#include "harness/experiment/reference_table.h"
#include "harness/files/turning_key.h"
#include "harness/fixtures/toml_number.h"
#include "harness/fixtures/toml_string.h"

namespace towbench::harness {
namespace {

constexpr std::array<std::string_view, 8> kKindNames{"trapezoid", "s_curve", "step", "sine",
                                                     "circle",    "steps",   "hold", "table"};
constexpr double kLongestWay_m = 1000.0;

struct Key {
  const char* name;
  double ReferenceMotion::*field;
  core::Range range;
  const char* meaning;
  unsigned kinds;  // bit of each kind that needs it
};

constexpr unsigned bit(ReferenceKind kind) {
  return 1U << static_cast<unsigned>(kind);
}
constexpr unsigned kWays = bit(ReferenceKind::kTrapezoid) | bit(ReferenceKind::kSCurve);
constexpr unsigned kTurning = bit(ReferenceKind::kSine) | bit(ReferenceKind::kCircle);

const std::array<Key, 10>& keys() {
  static const std::array<Key, 10> kKeys{{
      {"distance_m", &ReferenceMotion::distance_m, core::between(-kLongestWay_m, kLongestWay_m),
       "way, positive towards max", kWays | bit(ReferenceKind::kStep) | bit(ReferenceKind::kSteps)},
      {"speed_m_per_s", &ReferenceMotion::speed_m_per_s, core::between(1e-6, 100), "largest speed",
       kWays},
      {"acceleration_m_per_s2", &ReferenceMotion::acceleration_m_per_s2, core::between(1e-6, 1e4),
       "largest acceleration", kWays},
      {"amplitude_m", &ReferenceMotion::distance_m, core::between(1e-9, kLongestWay_m),
       "to either side", bit(ReferenceKind::kSine)},
      {"radius_m", &ReferenceMotion::distance_m, core::between(1e-9, kLongestWay_m),
       "of the circle", bit(ReferenceKind::kCircle)},
      {"period_s", &ReferenceMotion::period_s, core::between(1e-3, kLongestRun_s), "of one turn",
       kTurning},
      {"turns", &ReferenceMotion::turns, core::between(1, 1e6), "whole turns", kTurning},
      {"count", &ReferenceMotion::turns, core::between(1, 1e6), "whole number of steps",
       bit(ReferenceKind::kSteps)},
      {"every_s", &ReferenceMotion::period_s, core::between(1e-3, kLongestRun_s),
       "from step to step", bit(ReferenceKind::kSteps)},
      {"duration_s", &ReferenceMotion::period_s, core::between(1e-3, kLongestRun_s),
       "how long it stays", bit(ReferenceKind::kHold)},
  }};
  return kKeys;
}

bool is_in_radians(const TableReader& reader) {
  return std::any_of(keys().begin(), keys().end(), [&](const Key& key) {
    const auto turning = turning_key(key.name);
    return turning != key.name && reader.has(turning);
  });
}

ReferenceMotion read_motion(TableReader& reader) {
  ReferenceMotion motion;
  std::size_t kind = 0;
  reader.choice("move", kind, {kKindNames.begin(), kKindNames.end()});
  motion.kind = static_cast<ReferenceKind>(kind);
  std::size_t axis = 0;
  reader.choice("axis", axis, {core::kAxisNames.begin(), core::kAxisNames.end()});
  motion.axis = static_cast<core::Axis>(axis);
  reader.value("at_s", motion.at_s, core::between(0, kLongestRun_s), "when it begins");
  reader.require("move");
  reader.require("at_s");
  const bool of_both = motion.kind == ReferenceKind::kCircle;
  if (of_both && reader.has("axis")) {
    throw FixtureError(reader.place_of("axis"), "a key without effect", "a circle takes both axes");
  }
  if (!of_both) {
    reader.require("axis");
  }
  if (motion.in_radians = is_in_radians(reader); motion.in_radians) {
    reader.read_turning();
  }
  for (const Key& key : keys()) {
    if ((key.kinds & bit(motion.kind)) != 0) {
      reader.value(key.name, motion.*key.field, key.range, key.meaning);
      if (key.name != std::string_view("turns")) {
        reader.require(key.name);
      }
    } else if (reader.has(key.name)) {
      throw FixtureError(reader.place_of(key.name), "a key without effect",
                         fmt::format("no {} with move = \"{}\"", key.name, kKindNames[kind]));
    }
  }
  reader.text("file", motion.file, "path of a CSV file, relative to this one");
  if (motion.kind == ReferenceKind::kTable) {
    reader.require("file");
  } else if (reader.has("file")) {
    throw FixtureError(reader.place_of("file"), "a key without effect",
                       "only with move = \"table\"");
  }
  reader.finish();
  if (motion.distance_m == 0 && reader.has("distance_m")) {
    throw FixtureError(reader.place_of("distance_m"), "0", "a way");
  }
  if (motion.turns != std::floor(motion.turns)) {
    const char* const key = motion.kind == ReferenceKind::kSteps ? "count" : "turns";
    throw FixtureError(reader.place_of(key), toml_number(motion.turns), "a whole number");
  }
  return motion;
}

bool overlap(const ReferenceMotion& one, const ReferenceMotion& next) {
  const bool share =
      std::any_of(core::kAllAxes.begin(), core::kAllAxes.end(),
                  [&](core::Axis axis) { return one.moves(axis) && next.moves(axis); });
  return share && one.at_s + one.duration_s() > next.at_s;
}

// Each begins when the one before it on its axis has ended; a table that is not read yet has no
// duration.
void check_order(const std::vector<TableReader>& readers,
                 const std::vector<ReferenceMotion>& motions) {
  for (std::size_t i = 0; i < motions.size(); ++i) {
    for (std::size_t j = 0; j < i; ++j) {
      const auto& before = motions[j];
      if (before.at_s > motions[i].at_s || overlap(before, motions[i])) {
        throw FixtureError(readers[i].place_of("at_s"), toml_number(motions[i].at_s),
                           fmt::format("a time from {} on, when the motion before it has ended",
                                       toml_number(before.at_s + before.duration_s())));
      }
    }
  }
}

}  // namespace

std::vector<ReferenceMotion> read_reference(TableReader& experiment) {
  std::vector<ReferenceMotion> motions;
  auto readers = experiment.tables("reference");
  for (auto& reader : readers) {
    motions.push_back(read_motion(reader));
  }
  check_order(readers, motions);
  return motions;
}

void check_units(TableReader& experiment, const std::vector<ReferenceMotion>& motions,
                 const emulator::RigAxes& axes) {
  const auto readers = experiment.tables("reference");
  for (std::size_t i = 0; i < motions.size(); ++i) {
    const auto& motion = motions[i];
    const bool turning = axes[motion.axis].load_turns;
    for (const Key& key : keys()) {
      const auto in_rad = turning_key(key.name);
      const auto given = motion.in_radians ? in_rad : std::string(key.name);
      if (in_rad != key.name && readers[i].has(given) && motion.in_radians != turning) {
        throw FixtureError(
            readers[i].place_of(given),
            fmt::format("{} of an axis that {}", motion.in_radians ? "an angle" : "a way",
                        turning ? "turns" : "moves in a line"),
            turning ? in_rad : std::string(key.name));
      }
    }
  }
}

void read_reference_tables(TableReader& experiment, std::vector<ReferenceMotion>& motions,
                           SourceFiles& sources) {
  const auto readers = experiment.tables("reference");
  for (std::size_t i = 0; i < motions.size(); ++i) {
    auto& motion = motions[i];
    if (motion.kind == ReferenceKind::kTable) {
      const auto place = readers[i].place_of("file");
      motion.table =
          ReferenceTable::load(experiment.file().resolve(motion.file, place), place, sources);
    }
  }
  check_order(readers, motions);
}

std::string to_toml(const ReferenceMotion& motion) {
  auto text =
      fmt::format("\n[[reference]]\nmove = \"{}\"\nat_s = {}\n",
                  kKindNames[static_cast<std::size_t>(motion.kind)], toml_number(motion.at_s));
  if (motion.kind != ReferenceKind::kCircle) {
    text += fmt::format("axis = \"{}\"\n", core::name_of(motion.axis));
  }
  if (motion.kind == ReferenceKind::kTable) {
    text += "file = " + toml_string(motion.file) + '\n';
  }
  for (const Key& key : keys()) {
    if ((key.kinds & bit(motion.kind)) != 0) {
      const auto name = motion.in_radians ? turning_key(key.name) : std::string(key.name);
      text += fmt::format("{} = {}\n", name, toml_number(motion.*key.field));
    }
  }
  return text;
}

}  // namespace towbench::harness
