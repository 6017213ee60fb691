#include "harness/panel/frames.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <string_view>
#include <utility>
#include <vector>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "harness/judge/judge.h"
#include "harness/panel/shown_configuration.h"

namespace towbench::harness {
namespace {

using nlohmann::json;

static_assert(LiveTap::kKept_ns > FrameMaker::kShown_ns);

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
void add(std::string& text, const LiveTruthAxis& axis) {
  add(text, axis.carriage_m);
  add(text, axis.carriage_speed_m_per_s);
  add(text, axis.current_A);
  add(text, axis.transmission_force_N);
}
template <typename Integer>
void add_whole(std::string& text, Integer value) {
  const auto digits = fmt::format_int(value);
  text += ',';
  text.append(digits.data(), digits.size());
}

// By the time that the youngest is drawn the page has forgotten what is older.
template <typename Row, typename Time>
void forget_what_is_not_shown(std::vector<Row>& rows, Time time_ns) {
  const auto shown = std::find_if(rows.begin(), rows.end(), [&](const Row& row) {
    return time_ns(row) >= time_ns(rows.back()) - FrameMaker::kShown_ns;
  });
  rows.erase(rows.begin(), shown);
}

// An event's line is JSON of its own.
std::string list_of(std::string_view lines) {
  std::string list;
  for (std::size_t from = 0; from < lines.size();) {
    const auto end = std::min(lines.find('\n', from), lines.size());
    list += list.empty() ? "" : ",";
    list += lines.substr(from, end - from);
    from = end + 1;
  }
  return list;
}

void begin_row(std::string& text, core::Nanoseconds time_ns) {
  text += text.empty() ? "[" : ",[";
  add(text, core::seconds(time_ns), 1e6, "e-6");
}

}  // namespace

double FrameMaker::worst_error_m(const SeenRow& row) {
  double worst = 0;
  for (const auto which : core::kPlanarAxes) {
    worst = std::max(worst, std::fabs(row.live.reference_m[which] - row.position_m[which]));
  }
  return worst;
}

double FrameMaker::worst_error_m(const LiveTruth& row) {
  return std::fabs(static_cast<double>(row.axis(core::kFirstAxis).transmission_force_N));
}

template <typename Row>
std::vector<Row> FrameMaker::thinned(const std::vector<Row>& rows) {
  if (rows.size() <= kMostRows) {
    return rows;
  }
  std::vector<Row> some;
  some.reserve(kMostRows);
  const std::size_t buckets = kMostRows / 2;
  for (std::size_t i = 0; i < buckets; ++i) {
    const std::size_t from = i * rows.size() / buckets;
    const std::size_t end = (i + 1) * rows.size() / buckets;
    std::size_t worst = from;
    for (std::size_t row = from; row < end; ++row) {
      worst = worst_error_m(rows[row]) > worst_error_m(rows[worst]) ? row : worst;
    }
    if (worst + 1 < end) {
      some.push_back(rows[worst]);
    }
    some.push_back(rows[end - 1]);
  }
  return some;
}

// The first frame of a run; its fixture is there, its folder may not be yet.
void FrameMaker::begin(std::uint64_t number) {
  number_ = number;
  untold_.clear();
  tail_.reset();
  next_row_ = next_truth_ = missed_ = 0;
  estimators_.reset();
  if (const auto* const fixture = session_.fixture()) {
    const auto shown = shown_configuration(*fixture);
    estimators_.emplace(shown);
    shown_ = shown.shown;
    for (const auto which : shown_) {
      m_per_count_[which] = shown.axes[which].m_per_count();
    }
  }
}

// What has come since the last frame, or its end in a run that is shown in stretches.
template <typename Row>
void FrameMaker::catch_up(const LastRows<Row>& rows, std::uint64_t& next, std::vector<Row>& fresh) {
  auto from = next;
  if (const auto end = rows.written(); in_stretches_ && end > rows.least()) {
    from = std::max(from, end - rows.least());
  }
  const auto first = rows.copy(from, fresh);
  missed_ += in_stretches_ ? 0 : first - next;
  next = first + fresh.size();
}

std::vector<FrameMaker::SeenRow> FrameMaker::take_rows() {
  catch_up(session_.tap().rows(), next_row_, fresh_rows_);
  seen_.clear();
  for (const auto& live : fresh_rows_) {
    auto& seen = seen_.emplace_back();
    seen.live = live;
    if (estimators_) {
      seen.speeds = estimators_->update(live);
    }
    for (const auto which : shown_) {
      seen.position_m[which] =
          (static_cast<double>(live.axis(which).count) + 0.5) * m_per_count_[which];
    }
  }
  forget_what_is_not_shown(seen_, [](const SeenRow& row) { return row.live.time_ns; });
  return thinned(seen_);
}

std::vector<LiveTruth> FrameMaker::take_truths() {
  if (session_.state().clock == RunClock::kReal) {
    fresh_truths_ = tail_ ? tail_->rows() : std::vector<LiveTruth>{};
  } else {
    catch_up(session_.tap().truths(), next_truth_, fresh_truths_);
  }
  forget_what_is_not_shown(fresh_truths_, [](const LiveTruth& row) { return row.time_ns; });
  return thinned(fresh_truths_);
}

void FrameMaker::take_words() {
  if (const auto folder = session_.tap().folder(); !tail_ && !folder.empty()) {
    tail_.emplace(folder, shown_);
  }
  untold_.events += session_.tap().take_events();
  if (tail_ && session_.state().clock == RunClock::kReal) {
    untold_.events += tail_->events();
  }
  untold_.console += session_.tap().take_console();
  if (auto* const run_operator = session_.operator_if_running()) {
    if (auto trouble = run_operator->take_trouble(); !trouble.empty()) {
      untold_.trouble = std::move(trouble);
    }
  }
}

void FrameMaker::add_axis(std::string& text, const SeenRow& row, core::Axis which) {
  const auto axis = row.live.axis(which);
  add(text, axis.reference_m);
  add(text, row.position_m[which]);
  add(text, axis.reference_velocity_m_per_s);
  add(text, axis.velocity_m_per_s);
  add(text, axis.duty_pct);
  add_whole(text, axis.mode);
  for (const double speed : row.speeds[which]) {
    add(text, speed);
  }
}

// [t, then for y and x: reference, position, reference velocity, velocity, duty, mode, and velocity
// by frequency, by period and by the hybrid; then fault, and the force sensor's y and x; of a
// machine with further axes then the same nine for each of z to c]
std::string FrameMaker::text_of(const std::vector<SeenRow>& rows) const {
  std::string text;
  for (const auto& row : rows) {
    begin_row(text, row.live.time_ns);
    for (const auto which : core::kPlanarAxes) {
      add_axis(text, row, which);
    }
    add_whole(text, row.live.fault);
    for (const float force : row.live.force_N) {
      add(text, row.live.has_force ? force : std::nanf(""));
    }
    if (shows_further_axes()) {
      for (const auto which : core::kFurtherAxes) {
        add_axis(text, row, which);
      }
    }
    text += ']';
  }
  return text;
}

// [t, then for y and x: carriage, carriage speed, current, transmission force; then input lines; of
// a machine with further axes then the same four for each of z to c]
std::string FrameMaker::text_of(const std::vector<LiveTruth>& rows) const {
  std::string text;
  for (const auto& row : rows) {
    begin_row(text, row.time_ns);
    for (const auto which : core::kPlanarAxes) {
      add(text, row.axis(which));
    }
    add_whole(text, row.input_lines);
    if (shows_further_axes()) {
      for (const auto which : core::kFurtherAxes) {
        add(text, row.axis(which));
      }
    }
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
                 {"dropped", session_.tap().dropped() + missed_},
                 {"trouble", untold_.trouble}};
  if (auto* const run_operator = session_.operator_if_running()) {
    const auto pace = run_operator->pace();
    object["speed"] = pace.speed;
    object["paused"] = pace.paused;
    object["holds"] = run_operator->holds();
    object["active_faults"] = run_operator->active_faults();
  }
  if (const auto* const fixture = session_.fixture()) {
    auto& limits = object["limits"];
    auto& followed = object["followed"];
    const auto ends = limits_of(fixture->rig.parameters);
    const auto shown = shown_configuration(*fixture);
    for (const auto axis : shown.shown) {
      const auto& believed = shown.axes[axis];
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
          {"hard_max_m", ends[axis].hard_max_m},
          {"turns", ends[axis].turns}};
    }
    object["exchange_us_bins"] = session_.tap().exchange_times();
  }
  return object.dump(-1, ' ', false, json::error_handler_t::replace);
}

// What begins, pauses or ends is told at once.
bool FrameMaker::holds_back() {
  const auto state = session_.state();
  auto* const run_operator = session_.operator_if_running();
  const bool at_full_speed = run_operator != nullptr && state.clock == RunClock::kLockstep &&
                             run_operator->pace().speed == 0 && !run_operator->pace().paused;
  if (at_full_speed && told_at_full_speed_ == state.number && ++held_back_ < kHeldBack) {
    return true;
  }
  in_stretches_ = at_full_speed || told_at_full_speed_ == state.number;
  told_at_full_speed_ = at_full_speed ? std::optional(state.number) : std::nullopt;
  held_back_ = 0;
  return false;
}

std::string FrameMaker::next() {
  if (const auto number = session_.state().number; number != number_) {
    begin(number);
  }
  take_words();
  if (holds_back()) {
    return {};
  }
  const auto rows = take_rows();
  const auto truths = take_truths();
  auto state = state_text();
  if (rows.empty() && truths.empty() && untold_.is_empty() && state == last_state_) {
    return {};
  }
  auto frame = fmt::format(
      R"({{"kind":"frame","state":{},"rows":[{}],"truth":[{}],"events":[{}],"console":{}}})", state,
      text_of(rows), text_of(truths), list_of(untold_.events),
      json(untold_.console).dump(-1, ' ', true, json::error_handler_t::replace));
  last_state_ = std::move(state);
  untold_.clear();
  return frame;
}

std::string FrameMaker::greeting() {
  return fmt::format(
      R"({{"kind":"frame","state":{},"rows":[],"truth":[],"events":[],"console":""}})",
      state_text());
}

}  // namespace towbench::harness
