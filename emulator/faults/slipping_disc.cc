#include "emulator/faults/slipping_disc.h"

#include <algorithm>

#include "core/time.h"

namespace towbench::emulator {
namespace {

using protocol::EncoderLine;

// Edges of a jump inside one step: together about what a disc flung by its own coupling makes.
constexpr std::int64_t kMostTurnedPerStep = 400;

// Part of the step over which they come, and how far apart from the shaft's: several periods of a
// counter's clock.
constexpr core::Nanoseconds kTurning_ns = core::kPlantTick_ns * 9 / 10;
constexpr core::Nanoseconds kApart_ns = 50;

[[nodiscard]] std::int64_t modulo(std::int64_t value, std::int64_t divisor) noexcept {
  const std::int64_t rest = value % divisor;
  return rest < 0 ? rest + divisor : rest;
}

// Levels of A and B at a count (quadrature_encoder.h): A is high at 1 and 2 mod 4, B at 2 and 3.
[[nodiscard]] unsigned channels_at(std::int64_t count) noexcept {
  const std::int64_t phase = modulo(count, 4);
  return (phase == 1 || phase == 2 ? 1U : 0U) | (phase >= 2 ? 2U : 0U);
}

}  // namespace

void SlippingDisc::come_loose(std::int64_t shaft_count) noexcept {
  if (!loose_) {
    loose_ = true;
    shaft_ = shaft_count;
    disc_ = shaft_count;
  }
}

void SlippingDisc::slip(std::int64_t counts, std::int64_t shaft_count) noexcept {
  come_loose(shaft_count);
  to_slip_ = counts;
}

void SlippingDisc::turn(std::int64_t counts, std::int64_t shaft_count) noexcept {
  come_loose(shaft_count);
  to_turn_ = counts;
}

bool SlippingDisc::at_index() const noexcept {
  return index_count_ >= 0 &&
         modulo(disc_, counts_per_turn_) == modulo(index_count_, counts_per_turn_);
}

protocol::EncoderLevels SlippingDisc::levels() const noexcept {
  return static_cast<protocol::EncoderLevels>(channels_at(disc_) | (at_index() ? 4U : 0U));
}

void SlippingDisc::count(std::int64_t change, std::uint32_t time_ns, StepEdges& edges) noexcept {
  const protocol::EncoderLevels before = levels();
  disc_ += change;
  const unsigned changed = static_cast<unsigned>(before) ^ levels();
  for (unsigned line = 0; line < 3; ++line) {
    if (((changed >> line) & 1U) != 0 && edges.room() > 0) {
      edges.push_back({time_ns, static_cast<EncoderLine>(line)});
    }
  }
}

protocol::EncoderLevels SlippingDisc::follow(StepEdges& edges) noexcept {
  made_ = edges;
  edges.clear();
  // A jump's edges come evenly over the step, clear of those of the shaft: a disc that turns
  // steadily never makes two at once.
  const std::int64_t turned = std::clamp(to_turn_, -kMostTurnedPerStep, kMostTurnedPerStep);
  const std::int64_t size = turned < 0 ? -turned : turned;
  std::int64_t made = 0;
  core::Nanoseconds last_ns = -kApart_ns;
  const auto turn_until = [&](core::Nanoseconds end_ns) {
    for (; made < size; ++made) {
      const auto due_ns = std::max(made * kTurning_ns / size, last_ns + kApart_ns);
      if (due_ns > end_ns - kApart_ns) {
        return;
      }
      count(turned < 0 ? -1 : 1, static_cast<std::uint32_t>(due_ns), edges);
      last_ns = due_ns;
    }
  };
  to_turn_ -= turned;
  surplus_edges_ += size;
  for (const TimedEdge edge : made_.view()) {
    turn_until(edge.time_ns());
    last_ns = edge.time_ns();
    if (edge.line() == EncoderLine::kIndex) {
      continue;  // the disc's own comes where the disc's count is
    }
    // Upwards A toggles on entering odd counts, downwards on leaving them.
    const bool enters_odd = edge.line() == EncoderLine::kA;
    const bool is_odd = (shaft_ & 1) != 0;
    const std::int64_t change = enters_odd != is_odd ? 1 : -1;
    shaft_ += change;
    if (to_slip_ > 0) {
      --to_slip_;
      --surplus_edges_;
      continue;
    }
    count(change, static_cast<std::uint32_t>(edge.time_ns()), edges);
  }
  turn_until(core::kPlantTick_ns);
  return levels();
}

}  // namespace towbench::emulator
