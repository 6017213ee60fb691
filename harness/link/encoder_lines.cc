#include "harness/link/encoder_lines.h"

#include <algorithm>
#include <cstdlib>
#include <limits>

namespace towbench::harness {

using protocol::EncoderLevels;
using protocol::EncoderLine;

namespace {

constexpr std::array kLines{EncoderLine::kA, EncoderLine::kB, EncoderLine::kIndex};

std::uint32_t as_period(core::Nanoseconds time_ns) noexcept {
  return static_cast<std::uint32_t>(
      std::min<core::Nanoseconds>(time_ns, std::numeric_limits<std::uint32_t>::max()));
}

bool level_of(EncoderLevels levels, EncoderLine line) noexcept {
  return ((static_cast<unsigned>(levels) >> static_cast<unsigned>(line)) & 1U) != 0;
}

}  // namespace

// --- the controller's side -----------------------------------------------------------------------

void EncoderLinesAtController::ToPlant::handle(const protocol::Hello& hello) noexcept {
  owner.axes_mask_ = hello.axes_mask;
  protocol::Hello asked = hello;
  asked.capabilities &= ~protocol::kCapabilityEdges;
  owner.plant_.sink().on(asked);
}

void EncoderLinesAtController::ToPlant::handle(const protocol::Advance& advance) noexcept {
  owner.until_ns_ = advance.until_ns;
  owner.plant_.sink().on(advance);
}

void EncoderLinesAtController::ToController::handle(
    const protocol::EncoderEdges& /*edges*/) noexcept {
  owner.status_ = core::failure(core::ErrorCode::kProtocolCapabilities);
}

void EncoderLinesAtController::ToController::handle(
    const protocol::EncoderReport& report) noexcept {
  if (owner.times_ == EdgeTimes::kOfKernel) {
    owner.status_ = core::failure(core::ErrorCode::kProtocolCapabilities);
    return;
  }
  if (!core::is_planar(report.axis)) {
    owner.status_ = core::failure(core::ErrorCode::kMessageBadField);  // it has no lines
    return;
  }
  Encoder& encoder = owner.encoders_[report.axis];
  encoder.told_count = sum_of(encoder.told_count, report.count_change);
  encoder.told_pulses = static_cast<std::uint16_t>(encoder.told_pulses + report.index_pulses);
}

core::Status EncoderLinesAtController::wait_for(protocol::Turn expected) noexcept {
  const auto status = plant_.wait_for(expected);
  if (!status || expected != protocol::Turn::kAdvanced) {
    return status;
  }
  if (!started_) {
    return start();
  }
  if (const auto gathered = gather(); !gathered) {
    return gathered;
  }
  for (const core::Axis axis : core::kPlanarAxes) {
    if (((static_cast<unsigned>(axes_mask_) >> core::index_of(axis)) & 1U) != 0) {
      report(axis);
    }
  }
  return {};
}

// Nothing moves yet: what the lines did before, they did without a run.
core::Status EncoderLinesAtController::start() noexcept {
  started_ = true;
  start_ns_ = reader_.now_ns();
  if (const auto before = reader_.read(); !before) {
    return core::failure(before.error());
  }
  const auto levels = reader_.levels();
  if (!levels) {
    return core::failure(levels.error());
  }
  for (const core::Axis axis : core::kPlanarAxes) {
    unsigned own = 0;
    for (const EncoderLine line : kLines) {
      const unsigned level = static_cast<unsigned>(*levels) >> protocol::place_of(axis, line);
      own |= (level & 1U) << static_cast<unsigned>(line);
    }
    encoders_[axis].lines.start(static_cast<EncoderLevels>(own));
  }
  return status_;
}

core::Status EncoderLinesAtController::gather() noexcept {
  const core::Nanoseconds asked_ns = reader_.now_ns();
  for (;;) {
    const auto edges = reader_.read();
    if (!edges) {
      return core::failure(edges.error());
    }
    for (const protocol::LineEdge& edge : *edges) {
      take(edge);
    }
    if (!status_ || times_ == EdgeTimes::kOfKernel || has_all_that_was_told()) {
      return status_;
    }
    if (reader_.now_ns() - asked_ns > kEdgeLimit_ns) {
      return core::failure(core::ErrorCode::kSequence);
    }
  }
}

bool EncoderLinesAtController::has_all_that_was_told() const noexcept {
  return std::all_of(encoders_.begin(), encoders_.end(), [&](const Encoder& each) {
    return each.lines.count() == each.told_count &&
           (!reader_.has_index() || each.lines.index_pulses() == each.told_pulses);
  });
}

void EncoderLinesAtController::take(const protocol::LineEdge& edge) noexcept {
  Encoder& encoder = encoders_[protocol::axis_at(edge.place)];
  const EncoderLine line = protocol::line_at(edge.place);
  encoder.lines.toggle(line);
  if (line != EncoderLine::kIndex) {
    encoder.edge_before_ns = encoder.edge_ns;
    encoder.edge_ns = edge.time_ns;
  }
}

void EncoderLinesAtController::report(core::Axis axis) noexcept {
  Encoder& encoder = encoders_[axis];
  protocol::EncoderReport& report = encoder.report;
  report.axis = axis;
  report.time_ns = until_ns_;
  report.levels = encoder.lines.levels();
  report.count_change = change_of(encoder.lines.count(), encoder.reported_count);
  report.index_count = encoder.lines.index_count();
  report.index_pulses =
      static_cast<std::uint16_t>(encoder.lines.index_pulses() - encoder.reported_pulses);
  if (times_ == EdgeTimes::kOfKernel && encoder.edge_ns != 0) {
    report.last_edge_ns = std::clamp<core::Nanoseconds>(encoder.edge_ns - start_ns_, 1, until_ns_);
    report.capture_period_ns =
        encoder.edge_before_ns == 0 ? 0 : as_period(encoder.edge_ns - encoder.edge_before_ns);
  } else if (times_ == EdgeTimes::kOfExchange && report.count_change != 0) {
    const std::int64_t moved = std::abs(std::int64_t{report.count_change});
    report.capture_period_ns = as_period((until_ns_ - report.last_edge_ns) / moved);
    report.last_edge_ns = until_ns_;
  }
  encoder.reported_count = encoder.lines.count();
  encoder.reported_pulses = encoder.lines.index_pulses();
  to_controller_.to->on(report);
  ++report.sequence;
}

// --- the plant's side ----------------------------------------------------------------------------

EncoderLinesAtPlant::EncoderLinesAtPlant(protocol::MessageSink& plant,
                                         protocol::MessageSink& controller,
                                         protocol::EdgeDriver& driver,
                                         const core::PerPlanarAxis<EncoderLevels>& start_levels,
                                         bool tells_count) noexcept
    : in_(plant), out_(*this, controller), driver_(driver), tells_count_(tells_count) {
  for (const core::Axis axis : core::kPlanarAxes) {
    for (const EncoderLine line : kLines) {
      if (line != EncoderLine::kIndex || driver_.has_index()) {
        const auto set =
            driver_.set(protocol::place_of(axis, line), level_of(start_levels[axis], line));
        status_ = status_ ? set : status_;
      }
    }
    encoders_[axis].lines.start(start_levels[axis]);
    encoders_[axis].report.axis = axis;
  }
}

void EncoderLinesAtPlant::In::handle(const protocol::Hello& hello) noexcept {
  protocol::Hello asked = hello;
  asked.capabilities |= protocol::kCapabilityEdges;
  to.on(asked);
}

void EncoderLinesAtPlant::Out::handle(const protocol::EncoderEdges& edges) noexcept {
  if (!core::is_planar(edges.axis)) {
    owner.status_ = core::failure(core::ErrorCode::kMessageBadField);  // it has no lines
    return;
  }
  owner.encoders_[edges.axis].is_there = true;
  owner.adopt(edges.axis, edges.start_levels);
  for (const protocol::EncoderEdge edge : edges.edges.view()) {
    owner.toggle(edges.axis, edge.line());
  }
}

void EncoderLinesAtPlant::Out::handle(const protocol::Advanced& advanced) noexcept {
  for (const core::Axis axis : core::kPlanarAxes) {
    if (owner.tells_count_ && owner.encoders_[axis].is_there) {
      owner.tell(axis, advanced.time_ns);
    }
  }
  to.on(advanced);
}

void EncoderLinesAtPlant::toggle(core::Axis axis, EncoderLine line) noexcept {
  LineCount& lines = encoders_[axis].lines;
  lines.toggle(line);
  if (line == EncoderLine::kIndex && !driver_.has_index()) {
    return;
  }
  const auto set = driver_.set(protocol::place_of(axis, line), level_of(lines.levels(), line));
  status_ = status_ ? set : status_;
}

// Lines that have changed without an edge change now.
void EncoderLinesAtPlant::adopt(core::Axis axis, EncoderLevels levels) noexcept {
  for (const EncoderLine line : kLines) {
    if (level_of(levels, line) != level_of(encoders_[axis].lines.levels(), line)) {
      toggle(axis, line);
    }
  }
}

void EncoderLinesAtPlant::tell(core::Axis axis, core::Nanoseconds now_ns) noexcept {
  Encoder& encoder = encoders_[axis];
  protocol::EncoderReport& report = encoder.report;
  report.levels = encoder.lines.levels();
  report.time_ns = now_ns;
  report.count_change = change_of(encoder.lines.count(), encoder.told_count);
  report.index_count = encoder.lines.index_count();
  report.index_pulses =
      static_cast<std::uint16_t>(encoder.lines.index_pulses() - encoder.told_pulses);
  report.last_edge_ns = report.count_change != 0 ? now_ns : report.last_edge_ns;
  encoder.told_count = encoder.lines.count();
  encoder.told_pulses = encoder.lines.index_pulses();
  out_.to.on(report);
  ++report.sequence;
}

}  // namespace towbench::harness
