// Seeded random numbers with the same sequence everywhere (the standard's distributions differ
// between libraries). xoshiro256++ by Blackman and Vigna, seeded through splitmix64.
#pragma once

#include <array>
#include <bit>
#include <cstdint>

namespace towbench::core {

class Random {
 public:
  explicit constexpr Random(std::uint64_t seed) noexcept {
    for (auto& word : state_) {
      seed += 0x9e3779b97f4a7c15U;
      std::uint64_t z = seed;
      z = (z ^ (z >> 30U)) * 0xbf58476d1ce4e5b9U;
      z = (z ^ (z >> 27U)) * 0x94d049bb133111ebU;
      word = z ^ (z >> 31U);
    }
  }

  [[nodiscard]] constexpr std::uint64_t bits() noexcept {
    const std::uint64_t result = std::rotl(state_[0] + state_[3], 23) + state_[0];
    const std::uint64_t shifted = state_[1] << 17U;
    state_[2] ^= state_[0];
    state_[3] ^= state_[1];
    state_[1] ^= state_[2];
    state_[0] ^= state_[3];
    state_[2] ^= shifted;
    state_[3] = std::rotl(state_[3], 45);
    return result;
  }

  // Uniform in [0, 1).
  [[nodiscard]] constexpr double uniform() noexcept {
    return static_cast<double>(bits() >> 11U) * 0x1.0p-53;
  }

  // Mean 0, standard deviation 1, by the sum of twelve uniforms: bounded at +-6 and without libm.
  // Good to 1 % in the density inside 2.5 sigma; no user needs the far tail.
  [[nodiscard]] constexpr double gaussian() noexcept {
    double sum = -6.0;
    for (int i = 0; i < 12; ++i) {
      sum += uniform();
    }
    return sum;
  }

 private:
  std::array<std::uint64_t, 4> state_{};
};

}  // namespace towbench::core
