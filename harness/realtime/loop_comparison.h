// Our loop against a bare clock_nanosleep loop, on this host and in one run: what the recording and
// the policy cost in lateness.
#pragma once

#include <cstdint>
#include <string>

#include "core/time.h"

namespace towbench::harness {

struct LoopComparison {
  unsigned blocks = 0;  // of each kind
  core::Nanoseconds block_ns = 0;
  // Medians over the blocks of each block's own percentile.
  core::Nanoseconds bare_p50_ns = 0;
  core::Nanoseconds bare_p99_ns = 0;
  core::Nanoseconds ours_p50_ns = 0;
  core::Nanoseconds ours_p99_ns = 0;
  std::uint64_t bare_overruns = 0;
  std::uint64_t ours_overruns = 0;

  // Ours over bare; 0 without a block.
  [[nodiscard]] double p50_ratio() const noexcept;
  [[nodiscard]] double p99_ratio() const noexcept;
  [[nodiscard]] std::string text() const;
};

// Alternates blocks of both loops at 10 kHz in one thread with real-time rights. A host that gets
// worse or better meanwhile hits both alike.
[[nodiscard]] LoopComparison compare_loops(unsigned blocks, core::Nanoseconds block_ns);

}  // namespace towbench::harness
