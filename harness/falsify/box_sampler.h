// Samples of the unit box: uniform ones, from which it can be stated what was covered, and others
// where the smallest values often are, at the ends of the sides and in short stretches of them.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "core/random.h"

namespace towbench::harness {

using BoxPoint = std::vector<double>;  // each 0 .. 1

// A part of a side, for example a phase of a motion.
struct Stretch {
  double from = 0;
  double to = 1;  // > from
  [[nodiscard]] double length() const noexcept { return to - from; }
};

struct BoxSide {
  bool has_ends = true;              // false: a time, at whose ends nothing is special
  std::vector<Stretch> stretches{};  // each is sampled as often as the others; may be none
};

enum class SampleKind : std::uint8_t {
  kUniform,
  kAtEnds,     // each side that has ends at one of them, the others uniform
  kOfStretch,  // as many in each stretch, however short
};

inline constexpr const char* kSampleKindNames[] = {"uniform", "ends", "phase"};

struct BoxSample {
  BoxPoint point{};
  SampleKind kind = SampleKind::kUniform;
};

// Of ten samples of a box with ends and stretches three are uniform, two at ends, five of
// stretches; with `uniform_alone` all are uniform. Everything follows from the seed.
class BoxSampler {
 public:
  BoxSampler(std::vector<BoxSide> sides, std::uint64_t seed, bool uniform_alone = false);

  [[nodiscard]] BoxSample next();

 private:
  [[nodiscard]] BoxPoint uniform();
  [[nodiscard]] BoxPoint at_ends();
  [[nodiscard]] BoxPoint of_stretch();
  [[nodiscard]] std::size_t next_stretch();

  std::vector<BoxSide> sides_;
  std::uint64_t seed_;
  bool uniform_alone_;
  core::Random random_;
  bool has_ends_;
  std::size_t divided_;  // the first side with stretches; sides_.size(): none has
  std::size_t made_ = 0;
  std::vector<std::size_t> left_{};   // stretches that come before any comes again
  std::vector<std::size_t> taken_{};  // how often each was sampled
};

}  // namespace towbench::harness
