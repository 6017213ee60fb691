#include "harness/panel/edge_watch.h"

namespace towbench::harness {
namespace {

std::uint32_t bounded(core::Nanoseconds length_ns) noexcept {
  return length_ns > LastEdges::kLongAgo_ns ? LastEdges::kLongAgo_ns
                                            : static_cast<std::uint32_t>(length_ns);
}

}  // namespace

void EdgeWatch::note(core::Nanoseconds time_ns, std::int32_t step) noexcept {
  reversed_ = step != last_step_;
  last_step_ = step;
  edge_before_ns_ = last_edge_ns_;
  last_edge_ns_ = time_ns;
}

void EdgeWatch::take(const protocol::EncoderEdges& message) noexcept {
  const auto edges = message.edges.view();
  // All steps lie within an exchange, so 32 bits hold them; of the lines only the index has the
  // upper bit. Plain sums, which the compiler does four at a time.
  std::uint32_t length_ns = 0;
  std::uint32_t index_edges = 0;
  for (const auto edge : edges) {
    length_ns += edge.step_ns();
    index_edges += edge.packed() >> 31U;
  }
  const auto channel_edges = static_cast<std::uint32_t>(edges.size()) - index_edges;
  time_ns_ = message.end_ns;
  if (channel_edges == 0) {
    return;
  }
  // Backwards to the last two of A and B: an edge of A counts up when A = B before it.
  struct Found {
    core::Nanoseconds time_ns = 0;
    std::int32_t step = 0;
  };
  Found last;
  Found before;
  const auto start_levels = static_cast<std::uint32_t>(message.start_levels);
  const std::uint32_t parity = (start_levels ^ (start_levels >> 1U)) & 1U;
  core::Nanoseconds at_ns = message.start_ns + length_ns;
  std::uint32_t left = channel_edges;
  for (std::size_t i = edges.size(); i-- > 0 && before.step == 0 && left > 0;) {
    const auto line = edges[i].line();
    if (line != protocol::EncoderLine::kIndex) {
      --left;
      const std::uint32_t parity_before = parity ^ (left & 1U);
      const Found found{at_ns, static_cast<std::uint32_t>(line) == parity_before ? 1 : -1};
      (last.step == 0 ? last : before) = found;
    }
    at_ns -= edges[i].step_ns();
  }
  if (before.step != 0) {
    note(before.time_ns, before.step);
  }
  note(last.time_ns, last.step);
}

void EdgeWatch::take(const protocol::EncoderReport& report) noexcept {
  const auto change = report.count_change;
  if (change != 0) {
    const std::int32_t step = change > 0 ? 1 : -1;
    reversed_ = last_step_ != 0 && step != last_step_ && (change == 1 || change == -1);
    last_step_ = step;
  }
  if (report.last_edge_ns != 0) {
    last_edge_ns_ = report.last_edge_ns;
    edge_before_ns_ = report.last_edge_ns - report.capture_period_ns;
  }
  time_ns_ = report.time_ns;
}

LastEdges EdgeWatch::seen_from(core::Nanoseconds moment_ns) const noexcept {
  return {.before_ns = bounded(time_ns_ - last_edge_ns_),
          .apart_ns = bounded(last_edge_ns_ - edge_before_ns_),
          .heard_ns = static_cast<std::int32_t>(moment_ns - time_ns_),
          .any = last_step_ != 0,
          .same_way = edge_before_ns_ != 0 && !reversed_,
          .forward = last_step_ >= 0};
}

}  // namespace towbench::harness
