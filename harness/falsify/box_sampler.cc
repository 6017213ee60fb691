#include "harness/falsify/box_sampler.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>
#include <utility>

#include <boost/random/sobol.hpp>

#include "harness/falsify/shuffle.h"

namespace towbench::harness {
namespace {

using enum SampleKind;
constexpr std::array kKindOfTurn{kOfStretch, kUniform,   kOfStretch, kAtEnds,  kOfStretch,
                                 kUniform,   kOfStretch, kAtEnds,    kUniform, kOfStretch};

// Point `index` of a sequence that fills the box evenly: Sobol's, moved by a drawn vector (Cranley
// and Patterson, SIAM Journal on Numerical Analysis 13, 1976).
BoxPoint evenly_spread(std::size_t variables, std::size_t index, std::uint64_t seed) {
  boost::random::sobol sequence(variables);
  sequence.seed(index);
  core::Random shift(seed);
  BoxPoint point(variables);
  for (auto& x : point) {
    const double share =
        static_cast<double>(sequence()) / static_cast<double>(boost::random::sobol::max());
    x = share + shift.uniform();
    x -= std::floor(x);
  }
  return point;
}

}  // namespace

BoxSampler::BoxSampler(std::vector<BoxSide> sides, std::uint64_t seed, bool uniform_alone)
    : sides_(std::move(sides)),
      seed_(seed),
      uniform_alone_(uniform_alone),
      random_(seed),
      has_ends_(std::any_of(sides_.begin(), sides_.end(),
                            [](const BoxSide& side) { return side.has_ends; })),
      divided_(static_cast<std::size_t>(
          std::find_if(sides_.begin(), sides_.end(),
                       [](const BoxSide& side) { return !side.stretches.empty(); }) -
          sides_.begin())) {
  if (divided_ < sides_.size()) {
    taken_.resize(sides_[divided_].stretches.size());
  }
}

BoxPoint BoxSampler::uniform() {
  BoxPoint point(sides_.size());
  std::generate(point.begin(), point.end(), [this] { return random_.uniform(); });
  return point;
}

BoxSample BoxSampler::next() {
  const auto kind = uniform_alone_ ? kUniform : kKindOfTurn[made_++ % kKindOfTurn.size()];
  if (kind == kAtEnds && has_ends_) {
    return {at_ends(), kind};
  }
  if (kind == kOfStretch && divided_ < sides_.size()) {
    return {of_stretch(), kind};
  }
  return {uniform(), kUniform};
}

BoxPoint BoxSampler::at_ends() {
  auto point = uniform();
  for (std::size_t i = 0; i < point.size(); ++i) {
    if (sides_[i].has_ends) {
      point[i] = std::round(point[i]);
    }
  }
  return point;
}

BoxPoint BoxSampler::of_stretch() {
  const auto chosen = next_stretch();
  auto point = evenly_spread(sides_.size(), taken_[chosen]++, seed_ + chosen);
  for (std::size_t i = 0; i < point.size(); ++i) {
    const auto& stretches = sides_[i].stretches;
    if (!stretches.empty()) {
      const auto& stretch = stretches[i == divided_ ? chosen : random_.bits() % stretches.size()];
      point[i] = stretch.from + stretch.length() * point[i];
    }
  }
  return point;
}

std::size_t BoxSampler::next_stretch() {
  if (left_.empty()) {
    left_.resize(taken_.size());
    std::iota(left_.begin(), left_.end(), std::size_t{0});
    shuffle(left_, random_);
  }
  const auto next = left_.back();
  left_.pop_back();
  return next;
}

}  // namespace towbench::harness
