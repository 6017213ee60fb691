#include <algorithm>
#include <cmath>
#include <vector>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "harness/judge/judge.h"
#include "harness/panel/panel_json.h"

namespace towbench::harness {
namespace {

using nlohmann::json;

double worst_error_m(const bbmc::TelemetryRow& row) {
  double worst = 0;
  for (const auto axis : core::kAxes) {
    const auto& now = row.axes[axis];
    worst = std::max(worst, std::fabs(now.reference_m - now.position_m));
  }
  return worst;
}

double worst_error_m(const emulator::TruthRow& row) {
  return std::fabs(row.axes[core::Axis::kY].chain_force_N);
}

// Of each bucket the row with the largest figure and the last one, in order of time.
template <typename Row>
std::vector<Row> thinned(const std::vector<Row>& rows, std::size_t most) {
  if (rows.size() <= most) {
    return rows;
  }
  std::vector<Row> kept;
  const std::size_t buckets = most / 2;
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

// Seven digits: a tenth of a count over the whole tank, and a third of the bytes.
void add(std::string& text, double value) {
  text += std::isfinite(value) ? fmt::format(",{:.8g}", value) : ",null";
}

template <typename Row>
std::vector<Row> all_from(LiveTap& tap) {
  std::vector<Row> rows;
  Row row;
  while (tap.next(row)) {
    rows.push_back(row);
  }
  return thinned(rows, FrameMaker::kMostRows);
}

}  // namespace

// [t, then for y and x: reference, position, reference velocity, velocity, duty, mode; then fault]
std::string FrameMaker::rows_text() {
  std::string text;
  for (const auto& row : all_from<bbmc::TelemetryRow>(session_.tap())) {
    text += fmt::format("{}[{:.6f}", text.empty() ? "" : ",", core::seconds(row.time_ns));
    for (const auto axis : core::kAxes) {
      const auto& now = row.axes[axis];
      for (const double value : {now.reference_m, now.position_m, now.reference_velocity_m_per_s,
                                 now.velocity_m_per_s, now.duty_pct}) {
        add(text, value);
      }
      text += fmt::format(",{}", static_cast<int>(now.mode));
    }
    text += fmt::format(",{}]", core::number_of(row.fault));
  }
  return text;
}

// [t, then for y and x: carriage, carriage speed, current, chain force; then input lines]
std::string FrameMaker::truths_text() {
  std::string text;
  for (const auto& row : all_from<emulator::TruthRow>(session_.tap())) {
    text += fmt::format("{}[{:.6f}", text.empty() ? "" : ",", core::seconds(row.time_ns));
    for (const auto axis : core::kAxes) {
      const auto& now = row.axes[axis];
      for (const double value :
           {now.carriage_m, now.carriage_speed_m_per_s, now.current_A, now.chain_force_N}) {
        add(text, value);
      }
    }
    text += fmt::format(",{}]", row.input_lines);
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
    const auto ends = limits_of(fixture->rig.parameters);
    for (const auto axis : core::kAxes) {
      const auto& believed = fixture->controller.configuration.axes[axis];
      const double m_per_count = believed.m_per_count();
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
  const auto rows = rows_text();
  const auto truths = truths_text();
  const auto events = session_.tap().take_events();
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
