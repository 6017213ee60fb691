// The edges of one encoder inside one plant step, oldest first, packed so that a run of them is
// written without a branch.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>

#include "core/check.h"
#include "protocol/messages.h"

namespace towbench::emulator {

// Time from the start of the step in the low 30 bits, line in the upper two: as
// protocol::EncoderEdge, but with the time of the step instead of that of the edge before.
class TimedEdge {
 public:
  constexpr TimedEdge() noexcept = default;
  constexpr TimedEdge(std::uint32_t time_ns, protocol::EncoderLine line) noexcept
      : packed_(line_bits(line) | time_ns) {}

  [[nodiscard]] static constexpr TimedEdge from_packed(std::uint32_t packed) noexcept {
    TimedEdge edge;
    edge.packed_ = packed;
    return edge;
  }
  [[nodiscard]] static constexpr std::uint32_t line_bits(protocol::EncoderLine line) noexcept {
    return static_cast<std::uint32_t>(line) << 30U;
  }
  [[nodiscard]] constexpr std::uint32_t packed() const noexcept { return packed_; }
  [[nodiscard]] constexpr std::int32_t time_ns() const noexcept {
    return static_cast<std::int32_t>(packed_ & protocol::EncoderEdge::kMaxStep_ns);
  }
  [[nodiscard]] constexpr protocol::EncoderLine line() const noexcept {
    return static_cast<protocol::EncoderLine>(packed_ >> 30U);
  }

 private:
  std::uint32_t packed_ = 0;
};

// More than ten times what an encoder at its rated 200 kHz a channel makes in a step.
inline constexpr std::size_t kMaxEdgesPerStep = 1024;

class StepEdges {
 public:
  void clear() noexcept { size_ = 0; }
  [[nodiscard]] std::size_t size() const noexcept { return size_; }
  [[nodiscard]] bool empty() const noexcept { return size_ == 0; }
  [[nodiscard]] std::size_t room() const noexcept { return kMaxEdgesPerStep - size_; }
  [[nodiscard]] TimedEdge operator[](std::size_t i) const noexcept {
    core::check(i < size_);
    return edges_[i];
  }
  [[nodiscard]] std::span<const TimedEdge> view() const noexcept { return {edges_.data(), size_}; }

  // Room for `count` <= room() edges that the caller writes now.
  [[nodiscard]] std::span<TimedEdge> extend(std::size_t count) noexcept {
    core::check(count <= room());
    size_ += count;
    return {edges_.data() + size_ - count, count};
  }
  void push_back(TimedEdge edge) noexcept { extend(1)[0] = edge; }

 private:
  std::array<TimedEdge, kMaxEdgesPerStep> edges_;
  std::size_t size_ = 0;
};

}  // namespace towbench::emulator
