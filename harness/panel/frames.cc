#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "harness/judge/judge.h"
#include "harness/panel/panel_json.h"

namespace towbench::harness {
namespace {

using nlohmann::json;

// A number as a whole one with a power of ten, "-1234567e-8": a frame holds thousands, and whole
// ones are written ten times as fast.
void add(std::string& text, double value, double parts, std::string_view power) {
  constexpr double kMost = 9e18;  // of std::int64_t
  const double scaled = value * parts;
  if (!(std::fabs(scaled) < kMost)) {
    text += "null";
    return;
  }
  const auto whole = fmt::format_int(std::llround(scaled));
  text.append(whole.data(), whole.size());
  if (whole.size() != 1 || *whole.data() != '0') {
    text += power;
  }
}
// 10 nm and 10 nm/s: a two-hundredth of a count.
void add(std::string& text, double value) {
  text += ',';
  add(text, value, 1e8, "e-8");
}
// A, N, % of duty, and speeds to a micrometre a second.
void add(std::string& text, float value) {
  text += ',';
  add(text, static_cast<double>(value), 1e6, "e-6");
}
template <typename Integer>
void add_whole(std::string& text, Integer value) {
  const auto digits = fmt::format_int(value);
  text += ',';
  text.append(digits.data(), digits.size());
}

void begin_row(std::string& text, core::Nanoseconds time_ns) {
  text += text.empty() ? "[" : ",[";
  add(text, core::seconds(time_ns), 1e6, "e-6");
}

}  // namespace

double FrameMaker::worst_error_m(const SeenRow& row) {
  double worst = 0;
  for (const auto axis : core::kAxes) {
    worst = std::max(worst, std::fabs(row.live.reference_m[axis] - row.position_m[axis]));
  }
  return worst;
}

double FrameMaker::worst_error_m(const LiveTruth& row) {
  return std::fabs(static_cast<double>(row.chain_force_N[core::Axis::kY]));
}

template <typename Row>
std::vector<Row> FrameMaker::thinned(const std::vector<Row>& rows) {
  if (rows.size() <= kMostRows) {
    return rows;
  }
  std::vector<Row> kept;
  const std::size_t buckets = kMostRows / 2;
  for (std::size_t i = 0; i < buckets; ++i) {
    const std::size_t from = i * rows.size() / buckets;
    const std::size_t to = (i + 1) * rows.size() / buckets;
    std::size_t worst = from;
    for (std::size_t row = from; row < to; ++row) {
      worst = worst_error_m(rows[row]) > worst_error_m(rows[worst]) ? row : worst;
    }
    if (worst + 1 < to) {
      kept.push_back(rows[worst]);
    }
    kept.push_back(rows[to - 1]);
  }
  return kept;
}

// The first frame of a run; its fixture is there, its folder may not be yet.
void FrameMaker::begin(std::uint64_t number) {
  number_ = number;
  tail_.reset();
  estimators_.reset();
  if (const auto* const fixture = session_.fixture()) {
    estimators_.emplace(fixture->controller.configuration);
    for (const auto axis : core::kAxes) {
      m_per_count_[axis] = fixture->controller.configuration.axes[axis].m_per_count();
    }
  }
}

// [t, then for y and x: reference, position, reference velocity, velocity, duty, mode, and velocity
// by frequency, by period and by the hybrid; then fault, and the force sensor's y and x]
std::string FrameMaker::rows_text() {
  seen_.clear();
  for (SeenRow seen; session_.tap().next(seen.live);) {
    if (estimators_) {
      seen.speeds = estimators_->update(seen.live);
    }
    for (const auto axis : core::kAxes) {
      seen.position_m[axis] =
          (static_cast<double>(seen.live.count[axis]) + 0.5) * m_per_count_[axis];
    }
    seen_.push_back(seen);
  }
  std::string text;
  for (const auto& [live, position_m, speeds] : thinned(seen_)) {
    begin_row(text, live.time_ns);
    for (const auto axis : core::kAxes) {
      add(text, live.reference_m[axis]);
      add(text, position_m[axis]);
      add(text, live.reference_velocity_m_per_s[axis]);
      add(text, live.velocity_m_per_s[axis]);
      add(text, live.duty_pct[axis]);
      add_whole(text, live.mode[axis]);
      for (const double speed : speeds[axis]) {
        add(text, speed);
      }
    }
    add_whole(text, live.fault);
    for (const float force : live.force_N) {
      add(text, live.has_force ? force : std::nanf(""));
    }
    text += ']';
  }
  return text;
}

void FrameMaker::take_truths() {
  truths_.clear();
  if (session_.state().clock == RunClock::kReal) {
    if (tail_) {
      truths_ = tail_->rows();
    }
    return;
  }
  for (LiveTruth row; session_.tap().next(row);) {
    truths_.push_back(row);
  }
}

// [t, then for y and x: carriage, carriage speed, current, chain force; then input lines]
std::string FrameMaker::truths_text() {
  take_truths();
  std::string text;
  for (const auto& row : thinned(truths_)) {
    begin_row(text, row.time_ns);
    for (const auto axis : core::kAxes) {
      add(text, row.carriage_m[axis]);
      add(text, row.carriage_speed_m_per_s[axis]);
      add(text, row.current_A[axis]);
      add(text, row.chain_force_N[axis]);
    }
    add_whole(text, row.input_lines);
    text += ']';
  }
  return text;
}

std::string FrameMaker::state_text() {
  const auto state = session_.state();
  constexpr std::array<const char*, 4> kPhases{"idle", "running", "judging", "over"};
  json object = {{"phase", kPhases.at(static_cast<std::size_t>(state.phase))},
                 {"number", state.number},
                 {"name", state.name},
                 {"title", state.title},
                 {"clock", state.clock == RunClock::kReal ? "real" : "lockstep"},
                 {"timing", state.timing},
                 {"folder", state.folder},
                 {"verdict", state.verdict},
                 {"reason", state.reason},
                 {"dropped", session_.tap().dropped()}};
  if (auto* const hand = session_.hand_if_running()) {
    const auto pace = hand->pace();
    object["speed"] = pace.speed;
    object["paused"] = pace.paused;
    object["holds"] = hand->holds();
    object["broken"] = hand->broken();
    object["trouble"] = hand->take_trouble();
  }
  if (const auto* const fixture = session_.fixture()) {
    auto& limits = object["limits"];
    auto& followed = object["followed"];
    const auto ends = limits_of(fixture->rig.parameters);
    for (const auto axis : core::kAxes) {
      const auto& believed = fixture->controller.configuration.axes[axis];
      const double m_per_count = believed.m_per_count();
      constexpr std::array<const char*, LiveEstimators::kMethods> kMethods{"frequency", "period",
                                                                           "hybrid"};
      followed[std::string(core::name_of(axis))] =
          kMethods.at(static_cast<std::size_t>(believed.velocity.method));
      limits[std::string(core::name_of(axis))] = {
          {"soft_min_m", static_cast<double>(believed.ends.soft_min_count) * m_per_count},
          {"soft_max_m", static_cast<double>(believed.ends.soft_max_count) * m_per_count},
          {"exists", ends[axis].exists},
          {"hall_min_m", ends[axis].hall_min_m},
          {"hall_max_m", ends[axis].hall_max_m},
          {"hard_min_m", ends[axis].hard_min_m},
          {"hard_max_m", ends[axis].hard_max_m}};
    }
    object["exchange_us_bins"] = session_.tap().exchange_times();
  }
  return object.dump(-1, ' ', false, json::error_handler_t::replace);
}

std::string FrameMaker::next() {
  if (const auto number = session_.state().number; number != number_) {
    begin(number);
  }
  if (const auto folder = session_.tap().folder(); !tail_ && !folder.empty()) {
    tail_.emplace(folder);
  }
  const auto rows = rows_text();
  const auto truths = truths_text();
  auto events = session_.tap().take_events();
  if (tail_ && session_.state().clock == RunClock::kReal) {
    events += tail_->events();
  }
  const auto console = session_.tap().take_console();
  const auto state = state_text();
  if (rows.empty() && truths.empty() && events.empty() && console.empty() && state == last_state_) {
    return {};
  }
  last_state_ = state;
  // An event's line is JSON of its own.
  std::string lines;
  for (std::size_t from = 0; from < events.size();) {
    const auto end = std::min(events.find('\n', from), events.size());
    lines += (lines.empty() ? "" : ",") + events.substr(from, end - from);
    from = end + 1;
  }
  return fmt::format(
      R"({{"kind":"frame","state":{},"rows":[{}],"truth":[{}],"events":[{}],"console":{}}})", state,
      rows, truths, lines, json(console).dump(-1, ' ', true, json::error_handler_t::replace));
}

std::string FrameMaker::greeting() {
  return fmt::format(
      R"({{"kind":"frame","state":{},"rows":[],"truth":[],"events":[],"console":""}})",
      state_text());
}

}  // namespace towbench::harness
