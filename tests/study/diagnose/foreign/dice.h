// Random draws of the foreign machines: a generator of the standard library, not the project's own.
#pragma once

#include <cmath>
#include <cstdint>
#include <numbers>
#include <random>
#include <vector>

namespace towbench::tests::foreign {

inline constexpr double kTurn = 2 * std::numbers::pi;

[[nodiscard]] inline double direction(double v) {
  return v > 0 ? 1 : v < 0 ? -1 : 0;
}

class Dice {
 public:
  explicit Dice(std::uint64_t seed, std::uint64_t stream = 0) {
    std::seed_seq words{seed & 0xffffffffU, seed >> 32U, stream & 0xffffffffU, stream >> 32U};
    engine_.seed(words);
  }

  double uniform() { return static_cast<double>(engine_() >> 11U) * 0x1.0p-53; }
  double between(double low, double high) { return low + (high - low) * uniform(); }
  // Each decade is as likely.
  double log_between(double low, double high) { return low * std::pow(high / low, uniform()); }
  bool chance(double share) { return uniform() < share; }
  double sign() { return chance(0.5) ? 1 : -1; }
  // Both ends included.
  int whole(int low, int high) {
    return low + static_cast<int>(uniform() * static_cast<double>(high - low + 1));
  }
  template <class T>
  const T& pick(const std::vector<T>& from) {
    return from[static_cast<std::size_t>(uniform() * static_cast<double>(from.size()))];
  }
  // Box and Muller 1958.
  double gauss() {
    const double radius = std::sqrt(-2 * std::log(1 - uniform()));
    return radius * std::cos(kTurn * uniform());
  }
  std::uint64_t bits() { return engine_(); }

 private:
  std::mt19937_64 engine_;
};

}  // namespace towbench::tests::foreign
