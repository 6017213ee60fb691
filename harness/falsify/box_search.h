// Searches the unit box for the smallest value of a function that is costly and may be undefined:
// a share of samples (box_sampler.h), then an optimiser of NLopt from the best of them.
//
// Everything follows from the seed: the same seed gives the same points.
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <optional>
#include <string_view>
#include <vector>

#include "harness/falsify/box_sampler.h"

namespace towbench::harness {

enum class Optimiser : std::uint8_t {
  kUniform,  // nothing but uniform samples
  kSubplex,  // from the best samples, some runs each (Rowan 1990; NLopt LN_SBPLX)
  kCrs,      // controlled random search (Kaelo and Ali 2006; NLopt GN_CRS2_LM)
  kDirect,   // dividing rectangles (Gablonsky and Kelley 2001; NLopt GN_DIRECT_L)
  kEsch,     // evolutionary (da Silva Santos 2010; NLopt GN_ESCH)
};
inline constexpr std::string_view kOptimiserNames[] = {"uniform", "sbplx", "crs2", "direct",
                                                       "esch"};

struct BoxTrial {
  BoxPoint point{};
  std::optional<double> value{};       // none: undefined there
  std::optional<SampleKind> sample{};  // none: chosen by the optimiser
};

struct BoxSearchSettings {
  std::vector<BoxSide> sides = {{}};
  std::size_t runs = 100;
  std::uint64_t seed = 1;
  Optimiser optimiser = Optimiser::kSubplex;
  double sampled_share = 0.5;          // of the runs; not of kUniform
  std::optional<double> stop_below{};  // the search is over at a smaller value
  std::vector<BoxTrial> known{};       // made before: the optimiser begins at the best of them too
  std::vector<BoxPoint> begun{};       // where it has begun before, and begins no more
};

struct BoxSearchResult {
  std::vector<BoxTrial> trials{};     // in the order in which they were made
  std::optional<std::size_t> best{};  // of the smallest value, the first
  std::vector<BoxPoint> begun{};      // where the optimiser began
};

// `measure` is called once a trial; it returns the value there, or none.
[[nodiscard]] BoxSearchResult search_box(
    const BoxSearchSettings& settings,
    const std::function<std::optional<double>(const BoxTrial& trial)>& measure);

}  // namespace towbench::harness
