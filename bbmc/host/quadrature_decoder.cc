#include "bbmc/host/quadrature_decoder.h"

#include <cmath>

namespace towbench::bbmc {
namespace {

constexpr core::Nanoseconds kPeripheralClock_ns = 10;  // 100 MHz
constexpr std::uint8_t kLevelA = 1;
constexpr std::uint8_t kLevelB = 2;
constexpr std::uint8_t kLevelIndex = 4;
// A message that comes again or too late; further back it is a plant that has started anew.
constexpr std::uint32_t kRecent = 16;
constexpr auto kIndexLine = static_cast<std::uint32_t>(protocol::EncoderLine::kIndex);

}  // namespace

bool QuadratureDecoder::configure(const Eqep::Settings& settings) noexcept {
  const double period_ns = 1e9 / settings.capture_clock_Hz;
  const double whole_ns = std::floor(period_ns + 0.5);
  if (std::fabs(period_ns - whole_ns) > 1e-6) {
    return false;
  }
  settings_ = settings;
  capture_tick_ns_ = static_cast<core::Nanoseconds>(whole_ns);
  return true;
}

void QuadratureDecoder::load_position(std::uint32_t position) noexcept {
  counter_.count = static_cast<std::int64_t>(position);
}

// Its motion has been counted already, or was missed and would be counted out of place.
bool QuadratureDecoder::is_old(std::uint32_t sequence) const noexcept {
  const std::uint32_t behind = next_sequence_ - 1 - sequence;
  return started_ && behind < kRecent;
}

bool QuadratureDecoder::continues(std::uint32_t sequence, core::Nanoseconds start_ns) noexcept {
  const bool good = !started_ || (sequence == next_sequence_ && start_ns == time_ns_);
  next_sequence_ = sequence + 1;
  return good;
}

inline void QuadratureDecoder::Counter::channel(std::uint32_t line,
                                                core::Nanoseconds time_ns) noexcept {
  ++edges;
  const std::int32_t step = line == parity ? 1 : -1;
  parity ^= 1U;
  // The rare half of the test first: edges of steady motion alternate between the channels.
  const bool both_at_once =
      time_ns - last_edge_ns < kPeripheralClock_ns && line + last_line == 1 && last_step != 0;
  last_line = line;
  if (both_at_once) [[unlikely]] {
    // The first of the pair was counted before the second made it illegal: take it back.
    count -= last_step;
    ++illegal;
    last_step = 0;
    reversed = true;
    return;
  }
  count += step;
  reversed = step != last_step;
  last_step = step;
  edge_before_ns = last_edge_ns;
  last_edge_ns = time_ns;
}

inline std::size_t QuadratureDecoder::Counter::steady(std::span<const protocol::EncoderEdge> list,
                                                      core::Nanoseconds& time_ns) noexcept {
  if (last_step == 0) {
    return 0;
  }
  core::Nanoseconds now_ns = time_ns;
  core::Nanoseconds before_ns = last_edge_ns;
  core::Nanoseconds latest_ns = last_edge_ns;
  std::uint32_t previous = last_line;
  std::size_t taken = 0;
  for (const protocol::EncoderEdge edge : list) {
    const auto line = static_cast<std::uint32_t>(edge.line());
    if ((line ^ previous) != 1 || edge.step_ns() < kPeripheralClock_ns) {
      break;
    }
    now_ns += edge.step_ns();
    before_ns = latest_ns;
    latest_ns = now_ns;
    previous = line;
    ++taken;
  }
  if (taken > 0) {
    time_ns = now_ns;
    edge_before_ns = before_ns;
    last_edge_ns = latest_ns;
    last_line = previous;
    edges += taken;
    count += last_step * static_cast<std::int64_t>(taken);
    parity ^= static_cast<std::uint32_t>(taken & 1U);
    reversed = false;
  }
  return taken;
}

void QuadratureDecoder::Counter::index(bool rises) noexcept {
  index_level = rises;
  if (rises) {
    ++index_pulses;
    index_count = count;
  }
}

void QuadratureDecoder::adopt_levels(std::uint8_t levels, core::Nanoseconds time_ns) noexcept {
  if (!started_) {
    levels_ = levels;
    counter_.parity = (levels ^ static_cast<unsigned>(levels >> 1U)) & 1U;
    counter_.index_level = (levels & kLevelIndex) != 0;
    return;
  }
  // Lines that changed without an edge: the hardware sees the change now.
  const auto changed = static_cast<std::uint8_t>(levels ^ levels_);
  levels_ = levels;
  if ((changed & kLevelA) != 0) {
    counter_.channel(0, time_ns);
  }
  if ((changed & kLevelB) != 0) {
    counter_.channel(1, time_ns);
  }
  if ((changed & kLevelIndex) != 0) {
    counter_.index((levels & kLevelIndex) != 0);
  }
}

bool QuadratureDecoder::take(const protocol::EncoderEdges& message) noexcept {
  if (is_old(message.sequence)) {
    return false;
  }
  const bool good = continues(message.sequence, message.start_ns);
  adopt_levels(message.start_levels, message.start_ns);
  started_ = true;
  edges_known_ = true;
  core::Nanoseconds time_ns = message.start_ns;
  unsigned levels = levels_;
  Counter counter = counter_;
  const std::span<const protocol::EncoderEdge> edges = message.edges.view();
  for (std::size_t i = 0; i < edges.size(); ++i) {
    const std::uint32_t first_line = counter.last_line ^ 1U;
    if (const std::size_t run = counter.steady(edges.subspan(i), time_ns); run > 0) {
      // Alternating from first_line on: half of them each, the odd one is the first line's.
      const std::size_t of_first = (run + 1) / 2;
      levels ^= static_cast<unsigned>(of_first & 1U) << first_line;
      levels ^= static_cast<unsigned>((run - of_first) & 1U) << (first_line ^ 1U);
      i += run;
      if (i == edges.size()) {
        break;
      }
    }
    const protocol::EncoderEdge edge = edges[i];
    time_ns += edge.step_ns();
    const auto line = static_cast<std::uint32_t>(edge.line());
    levels ^= 1U << line;
    if (line < kIndexLine) [[likely]] {
      counter.channel(line, time_ns);
    } else {
      counter.index((levels & kLevelIndex) != 0);
    }
  }
  counter_ = counter;
  levels_ = static_cast<std::uint8_t>(levels);
  time_ns_ = message.end_ns;
  return good;
}

bool QuadratureDecoder::take(const protocol::EncoderReport& report) noexcept {
  if (is_old(report.sequence)) {
    return false;
  }
  const bool good = !started_ || report.sequence == next_sequence_;
  next_sequence_ = report.sequence + 1;
  started_ = true;
  edges_known_ = false;
  const std::int64_t change = report.count_change;
  counter_.count += change;
  counter_.edges += static_cast<std::uint64_t>(change < 0 ? -change : change);
  counter_.illegal += report.illegal_transitions;
  if (report.index_pulses > 0) {
    counter_.index_pulses += report.index_pulses;
    counter_.index_count =
        report.index_count;  // of a counter that started at 0 with the run, as ours did
  }
  if (change != 0) {
    const std::int32_t step = change > 0 ? 1 : -1;
    counter_.reversed =
        counter_.last_step != 0 && step != counter_.last_step && (change == 1 || change == -1);
    counter_.last_step = step;
  }
  if (report.last_edge_ns != 0) {
    counter_.last_edge_ns = report.last_edge_ns;
    // Without a period there is no edge before that one.
    counter_.edge_before_ns =
        report.capture_period_ns == 0 ? 0 : report.last_edge_ns - report.capture_period_ns;
  }
  time_ns_ = report.time_ns;
  return good;
}

Eqep::Reading QuadratureDecoder::read() const noexcept {
  const auto ticks_until = [this](core::Nanoseconds time_ns) { return time_ns / capture_tick_ns_; };
  const auto saturated = [](core::Nanoseconds ticks) {
    return ticks > kCaptureSaturation_ticks ? kCaptureSaturation_ticks
                                            : static_cast<std::uint32_t>(ticks);
  };
  const core::Nanoseconds at_edge = ticks_until(counter_.last_edge_ns);
  Eqep::Reading reading;
  reading.time_ns = time_ns_;
  reading.position = wrapped(counter_.count);
  reading.since_edge_ticks = counter_.last_step == 0 ? kCaptureSaturation_ticks
                                                     : saturated(ticks_until(time_ns_) - at_edge);
  const core::Nanoseconds period = at_edge - ticks_until(counter_.edge_before_ns);
  reading.capture_ticks = saturated(period);
  reading.capture_valid =
      counter_.edge_before_ns != 0 && !counter_.reversed && period < kCaptureSaturation_ticks;
  reading.forward = counter_.last_step >= 0;
  reading.edges = static_cast<std::uint32_t>(counter_.edges);
  reading.illegal_transitions = counter_.illegal;
  reading.index_pulses = counter_.index_pulses;
  reading.index_position = wrapped(counter_.index_count);
  reading.edges_known = edges_known_;
  return reading;
}

std::uint32_t QuadratureDecoder::wrapped(std::int64_t count) const noexcept {
  const std::int64_t range = static_cast<std::int64_t>(settings_.position_max) + 1;
  if (count >= 0 && count < range) [[likely]] {
    return static_cast<std::uint32_t>(count);
  }
  const std::int64_t rest = count % range;
  return static_cast<std::uint32_t>(rest < 0 ? rest + range : rest);
}

}  // namespace towbench::bbmc
