#include "protocol/carriers/can_digest.h"

#include <algorithm>
#include <limits>

#include "protocol/carriers/can_layout.h"

namespace towbench::protocol {
namespace {

using namespace can_bits;

enum class Edges : std::uint8_t { kNone = 0, kOne = 1, kSeveral = 2 };

// As the quadrature peripheral's capture timer forms it: it stops at its largest value, and a first
// edge has no period.
std::uint32_t period_between(const EncoderReport& before, core::Nanoseconds edge_ns) noexcept {
  if (before.last_edge_ns == 0) {
    return before.capture_period_ns;
  }
  constexpr core::Nanoseconds kLongest_ns = std::numeric_limits<std::uint32_t>::max();
  return static_cast<std::uint32_t>(std::min(edge_ns - before.last_edge_ns, kLongest_ns));
}

Edges edges_between(const EncoderReport& before, const EncoderReport& report) noexcept {
  if (report.last_edge_ns == before.last_edge_ns &&
      report.capture_period_ns == before.capture_period_ns) {
    return Edges::kNone;
  }
  return report.capture_period_ns == period_between(before, report.last_edge_ns) ? Edges::kOne
                                                                                 : Edges::kSeveral;
}

bool same(const EncoderReport& a, const EncoderReport& b) noexcept {
  return a.axis == b.axis && a.levels == b.levels && a.time_ns == b.time_ns &&
         a.count_change == b.count_change && a.last_edge_ns == b.last_edge_ns &&
         a.capture_period_ns == b.capture_period_ns && a.index_count == b.index_count &&
         a.index_pulses == b.index_pulses && a.illegal_transitions == b.illegal_transitions &&
         a.sequence == b.sequence;
}

}  // namespace

std::optional<CanDigest::Packed> CanDigest::compress(const EncoderReport& report) const noexcept {
  const Edges edges = edges_between(last_, report);
  const auto age_ns = static_cast<std::uint64_t>(report.time_ns - report.last_edge_ns);
  const bool has_index = report.index_pulses != 0 || report.index_count != last_.index_count;

  Packed packed;
  packed.digest =
      kDigestCountChange.put(static_cast<std::uint64_t>(report.count_change)) |
      kDigestLevels.put(report.levels) | kDigestEdges.put(static_cast<std::uint64_t>(edges)) |
      kDigestIndexFollowed.put(has_index ? 1U : 0U) | kDigestSequence.put(report.sequence);
  packed.digest |= edges != Edges::kNone ? kDigestLastEdgeAge_ns.put(age_ns) : 0U;
  packed.digest |=
      edges == Edges::kSeveral ? kDigestCapturePeriod_ns.put(report.capture_period_ns) : 0U;
  if (has_index) {
    packed.index = kIndexCount.put(static_cast<std::uint32_t>(report.index_count)) |
                   kIndexPulses.put(report.index_pulses) | kIndexSequence.put(report.sequence);
  }
  // One rule for all that may not fit or not follow: only what comes back the same is sent packed.
  const auto again = expand(report.axis, packed);
  return again && same(*again, report) ? std::optional(packed) : std::nullopt;
}

std::optional<EncoderReport> CanDigest::expand(core::Axis axis,
                                               const Packed& packed) const noexcept {
  const std::uint64_t word = packed.digest;
  const std::uint32_t sequence = last_.sequence + 1U;
  const bool has_index = kDigestIndexFollowed.get(word) != 0;
  if (noted_ < 2 || kDigestSequence.get(word) != (sequence & kDigestSequence.mask()) ||
      has_index != packed.index.has_value()) {
    return std::nullopt;
  }
  EncoderReport report{
      .axis = axis,
      .levels = static_cast<EncoderLevels>(kDigestLevels.get(word)),
      .time_ns = last_.time_ns + interval_ns_,
      .count_change = static_cast<std::int32_t>(kDigestCountChange.get_signed(word)),
      .last_edge_ns = last_.last_edge_ns,
      .capture_period_ns = last_.capture_period_ns,
      .index_count = last_.index_count,
      .sequence = sequence};
  if (has_index) {
    if (kIndexSequence.get(*packed.index) != (sequence & kIndexSequence.mask())) {
      return std::nullopt;
    }
    report.index_count = static_cast<std::int32_t>(kIndexCount.get_signed(*packed.index));
    report.index_pulses = static_cast<std::uint16_t>(kIndexPulses.get(*packed.index));
  }
  switch (static_cast<Edges>(kDigestEdges.get(word))) {
    case Edges::kNone:
      return report;
    case Edges::kOne:
    case Edges::kSeveral:
      break;
    default:
      return std::nullopt;
  }
  report.last_edge_ns =
      report.time_ns - static_cast<core::Nanoseconds>(kDigestLastEdgeAge_ns.get(word));
  if (report.last_edge_ns < last_.last_edge_ns) {
    return std::nullopt;
  }
  report.capture_period_ns = static_cast<Edges>(kDigestEdges.get(word)) == Edges::kOne
                                 ? period_between(last_, report.last_edge_ns)
                                 : static_cast<std::uint32_t>(kDigestCapturePeriod_ns.get(word));
  return report;
}

void CanDigest::note(const EncoderReport& report) noexcept {
  const bool follows = noted_ > 0 && report.sequence == last_.sequence + 1U;
  interval_ns_ = follows ? report.time_ns - last_.time_ns : 0;
  noted_ = follows ? 2 : 1;
  last_ = report;
}

}  // namespace towbench::protocol
