#include "harness/experiment/reference_text.h"

#include <algorithm>
#include <array>
#include <cmath>

#include <fmt/format.h>

#include "harness/fixtures/toml_number.h"

namespace towbench::harness {
namespace {

constexpr std::array<std::string_view, 5> kKindNames{"trapezoid", "s_curve", "step", "sine",
                                                     "circle"};
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

const std::array<Key, 7>& keys() {
  static const std::array<Key, 7> kKeys{{
      {"distance_m", &ReferenceMotion::distance_m, core::between(-kLongestWay_m, kLongestWay_m),
       "way, positive towards max", kWays | bit(ReferenceKind::kStep)},
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
  }};
  return kKeys;
}

ReferenceMotion read_motion(TableReader& reader) {
  ReferenceMotion motion;
  std::size_t kind = 0;
  reader.choice("move", kind, {kKindNames.begin(), kKindNames.end()});
  motion.kind = static_cast<ReferenceKind>(kind);
  std::size_t axis = 0;
  reader.choice("axis", axis, {"y", "x"});
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
  for (const Key& key : keys()) {
    if ((key.kinds & bit(motion.kind)) != 0) {
      reader.value(key.name, motion.*key.field, key.range, key.meaning);
      if (key.field != &ReferenceMotion::turns) {
        reader.require(key.name);
      }
    } else if (reader.has(key.name)) {
      throw FixtureError(reader.place_of(key.name), "a key without effect",
                         fmt::format("no {} with move = \"{}\"", key.name, kKindNames[kind]));
    }
  }
  reader.finish();
  if (motion.distance_m == 0) {
    throw FixtureError(reader.place_of("distance_m"), "0", "a way");
  }
  if (motion.turns != std::floor(motion.turns)) {
    throw FixtureError(reader.place_of("turns"), toml_number(motion.turns), "whole turns");
  }
  return motion;
}

bool overlap(const ReferenceMotion& one, const ReferenceMotion& next) {
  const bool share = std::any_of(core::kAxes.begin(), core::kAxes.end(), [&](core::Axis axis) {
    return one.moves(axis) && next.moves(axis);
  });
  return share && one.at_s + one.duration_s() > next.at_s;
}

}  // namespace

std::vector<ReferenceMotion> read_reference(TableReader& experiment) {
  std::vector<ReferenceMotion> motions;
  for (auto& reader : experiment.tables("reference")) {
    const auto motion = read_motion(reader);
    for (const auto& before : motions) {
      if (before.at_s > motion.at_s || overlap(before, motion)) {
        throw FixtureError(reader.place_of("at_s"), toml_number(motion.at_s),
                           fmt::format("a time from {} on, when the motion before it has ended",
                                       toml_number(before.at_s + before.duration_s())));
      }
    }
    motions.push_back(motion);
  }
  return motions;
}

std::string to_toml(const ReferenceMotion& motion) {
  auto text =
      fmt::format("\n[[reference]]\nmove = \"{}\"\nat_s = {}\n",
                  kKindNames[static_cast<std::size_t>(motion.kind)], toml_number(motion.at_s));
  if (motion.kind != ReferenceKind::kCircle) {
    text += fmt::format("axis = \"{}\"\n", core::name_of(motion.axis));
  }
  for (const Key& key : keys()) {
    if ((key.kinds & bit(motion.kind)) != 0) {
      text += fmt::format("{} = {}\n", key.name, toml_number(motion.*key.field));
    }
  }
  return text;
}

}  // namespace towbench::harness
