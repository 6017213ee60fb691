#include "protocol/carriers/edge_order.h"

#include <algorithm>

namespace towbench::protocol {
namespace {

bool comes_before(std::uint32_t one, std::uint32_t other) noexcept {
  return static_cast<std::int32_t>(one - other) < 0;
}

}  // namespace

core::Status EdgeOrder::add(const NumberedEdge& edge) noexcept {
  if (edge.edge.place >= last_of_line_.size() || waiting_count_ == waiting_.size() ||
      edge.line_sequence != last_of_line_[edge.edge.place] + 1 ||
      comes_before(edge.sequence, next_)) {
    return core::failure(core::ErrorCode::kSequence);
  }
  last_of_line_[edge.edge.place] = edge.line_sequence;
  std::size_t at = waiting_count_++;
  while (at > 0 && comes_before(edge.sequence, waiting_[at - 1].sequence)) {
    waiting_[at] = waiting_[at - 1];
    --at;
  }
  waiting_[at] = edge;
  return {};
}

core::Result<std::span<const LineEdge>> EdgeOrder::take(core::Nanoseconds now_ns) noexcept {
  std::size_t count = 0;
  while (count < waiting_count_ && waiting_[count].sequence == next_) {
    taken_[count] = waiting_[count].edge;
    ++count;
    ++next_;
  }
  std::copy(waiting_.begin() + static_cast<std::ptrdiff_t>(count),
            waiting_.begin() + static_cast<std::ptrdiff_t>(waiting_count_), waiting_.begin());
  waiting_count_ -= count;
  if (waiting_count_ > 0 && now_ns - waiting_[0].edge.time_ns > kPatience_ns) {
    return core::failure(core::ErrorCode::kSequence);
  }
  return std::span<const LineEdge>(taken_.data(), count);
}

}  // namespace towbench::protocol
