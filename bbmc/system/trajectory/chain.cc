#include "bbmc/system/trajectory/chain.h"

#include <cmath>

namespace towbench::bbmc {
namespace {

constexpr double kJoint_m = 1e-9;
constexpr double kJoint_m_per_s = 1e-9;

Reference reference_of(const Segment& segment, double time_s) noexcept {
  return std::visit([time_s](const auto& shape) { return shape.at(time_s); }, segment);
}

double duration_of(const Segment& segment) noexcept {
  return std::visit([](const auto& shape) { return shape.duration_s(); }, segment);
}

bool joined(const Segment& before, const Segment& after) noexcept {
  const Reference end = reference_of(before, duration_of(before));
  const Reference start = reference_of(after, 0);
  return std::fabs(end.position_m - start.position_m) <= kJoint_m &&
         std::fabs(end.velocity_m_per_s - start.velocity_m_per_s) <= kJoint_m_per_s;
}

}  // namespace

core::Result<Chain> Chain::make(std::span<const Segment> segments) noexcept {
  if (segments.empty() || segments.size() > kMaxSegments) {
    return core::failure(core::ErrorCode::kRequestBadArgument);
  }
  Chain chain;
  chain.size_ = segments.size();
  double end_s = 0;
  for (std::size_t i = 0; i < segments.size(); ++i) {
    if (i > 0 && !joined(segments[i - 1], segments[i])) {
      return core::failure(core::ErrorCode::kRequestBadArgument);
    }
    end_s += duration_of(segments[i]);
    chain.segments_[i] = segments[i];
    chain.ends_s_[i] = end_s;
  }
  return chain;
}

Reference Chain::at(double time_s) const noexcept {
  std::size_t i = 0;
  while (i + 1 < size_ && time_s >= ends_s_[i]) {
    ++i;
  }
  return reference_of(segments_[i], i == 0 ? time_s : time_s - ends_s_[i - 1]);
}

}  // namespace towbench::bbmc
